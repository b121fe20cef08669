// What happens, as the station sees it now. The page asks for what is newer than it has seen, and
// the station answers once, with the newest: nothing ever queues up.
//
//   const live = liveFeed();
//   live.state      { phase, time, … }           live.missions   Map of name → row, in order
//   live.log        [[seq, t, mission, text, kind]…]  live.drones   Map of id → row
//   live.results    [[seq, t, mission, trip, round, attempt, drone, kind, value]…]
//   live.age()      how old all this is, in ms   live.lost()     is the connection lost?
//   live.made       when the station made it, by its own clock (ms)
//   live.changed.heard((changes) => …)   once a frame at most, where there is something new:
//     changes = { fresh, missions: Set of names, drones: Set of ids, log: [new], results: [new] }
//     `fresh`: another flight, everything that was there before is gone
//   live.other.heard(() => …)            another server answers: it was started again
//   live.denied.heard(() => …)           the station wants its token first
//   live.start()

import { bell } from "./bell.js";
import { connection } from "./connection.js";

const KEPT = 5000; // lines and results

const nothing = () => ({
  fresh: false, missions: new Set(), drones: new Set(), log: [], results: [],
});

export function liveFeed() {
  const live = {
    server: null, flight: "", n: 0, made: 0, state: { phase: "unknown", time: 0 },
    missions: new Map(), drones: new Map(), log: [], results: [],
    changed: bell(), other: bell(), denied: bell(),
  };
  let seenLog = 0;
  let seenResults = 0;
  let changes = nothing();
  let heard = -Infinity;
  let offset = Infinity; // the station's clock against ours, with the shortest way of a message
  let late = 0;
  let drawing = false;

  function forget() {
    Object.assign(live, {
      missions: new Map(), drones: new Map(), log: [], results: [], n: 0, flight: "",
    });
    seenLog = seenResults = 0;
    changes = { ...nothing(), fresh: true };
  }

  function draw() {
    if (drawing) return;
    drawing = true;
    requestAnimationFrame(() => {
      drawing = false;
      const now = changes;
      changes = nothing();
      live.changed.ring(now);
    });
  }

  function rows(kind, key, list = []) {
    for (const row of list) {
      live[kind].set(row[key], row);
      changes[kind].add(row[key]);
    }
  }

  function lines(kind, list = []) {
    live[kind].push(...list);
    if (live[kind].length > KEPT * 1.2) live[kind].splice(0, live[kind].length - KEPT);
    changes[kind].push(...list);
    if (changes[kind].length > KEPT) changes[kind].splice(0, changes[kind].length - KEPT);
    return list.length ? list[list.length - 1][0] : 0;
  }

  function take(message) {
    if (message.server !== live.server) {
      const first = live.server === null;
      live.server = message.server;
      if (!first) {
        forget(); // what it counts is not what the one before counted: ask for all
        offset = Infinity;
        live.other.ring();
        return;
      }
    }
    if (message.flight !== live.flight) forget();
    const now = Date.now() - message.made;
    offset = Math.min(offset, now);
    late = now - offset;
    heard = performance.now();
    Object.assign(live, {
      flight: message.flight, n: message.n, made: message.made, state: message.state,
    });
    rows("missions", "name", message.missions);
    rows("drones", "id", message.drones);
    seenLog = Math.max(seenLog, lines("log", message.log));
    seenResults = Math.max(seenResults, lines("results", message.results));
    draw();
  }

  const wanted = () => ({
    flight: live.flight, seen: live.n, log: seenLog, results: seenResults,
  });
  const line = connection(wanted, take, live.denied.ring);
  live.age = () => performance.now() - heard + late;
  live.lost = () => live.age() > 3000;
  live.start = line.start;
  return live;
}
