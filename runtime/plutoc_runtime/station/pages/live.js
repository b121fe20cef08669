// What happens, as the station sees it now. The page asks for what is newer than it has seen, and
// gets the newest, once: nothing queues up. By WebSocket, or by plain requests where that fails.

import { get, token, wait } from "./api.js";
import { bell } from "./dom.js";

const KEPT = 5000; // lines and results
const SILENCE = 4000; // ms; the station answers after a second at the latest
const POLLS = 30; // so many plain requests before the WebSocket is tried again
const NO_TOKEN = 4401;

// A hidden page takes its time, until it is looked at again.
const leisure = () => document.hidden && Promise.race([wait(1000),
  new Promise((done) => document.addEventListener("visibilitychange", done, { once: true }))]);

// Both resolve when the line is gone, with how many messages came.
function throughSocket(wanted, take, denied) {
  return new Promise((done) => {
    let count = 0;
    let alarm = 0;
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/api/live`);
    const over = () => {
      clearTimeout(alarm);
      socket.onclose = socket.onmessage = socket.onopen = null;
      socket.close();
      done(count);
    };
    const expect = () => {
      clearTimeout(alarm);
      alarm = setTimeout(over, SILENCE);
    };
    const ask = (more) => {
      expect();
      socket.send(JSON.stringify({ ...more, ...wanted() }));
    };
    expect();
    socket.onopen = () => ask(token() ? { token: token() } : {});
    socket.onclose = ({ code }) => {
      if (code === NO_TOKEN) denied();
      over();
    };
    socket.onmessage = async ({ data }) => {
      expect();
      count += 1;
      take(JSON.parse(data));
      await leisure();
      if (socket.readyState === WebSocket.OPEN) ask();
    };
  });
}

async function byRequests(wanted, take, denied) {
  let count = 0;
  try {
    for (; count < POLLS; count += 1) {
      take(await get(`/api/live?${new URLSearchParams(wanted())}`, SILENCE));
      await leisure();
      await wait(80);
    }
  } catch (error) {
    if (error.status === 401) denied();
  }
  return count;
}

async function keepOn(...how) {
  for (let failed = 0; ;) {
    const requests = failed % 3 === 2;
    const count = await (requests ? byRequests : throughSocket)(...how);
    if (requests && count === POLLS) failed = 1; // they work; one try of the WebSocket
    else failed = count ? 0 : failed + 1;
    await wait(count ? 50 : Math.min(2000, 150 * 2 ** Math.min(failed, 4)));
  }
}

const fresh = () => ({ missions: new Map(), drones: new Map(), log: [], results: [] });
const nothing = (anew) => ({
  fresh: anew, missions: new Set(), drones: new Set(), log: [], results: [],
});

// → state, missions (by name), drones (by id), log, results; changed.heard(({ fresh, missions, drones,
// log, results }) => …) a frame at most; other: another server answers; denied: it wants its token.
export function liveFeed() {
  const live = {
    ...fresh(), server: null, flight: "", n: 0, made: 0, state: { phase: "unknown", time: 0 },
    changed: bell(), other: bell(), denied: bell(),
  };
  let seen = { log: 0, results: 0 };
  let changes = nothing(true);
  let heard = -Infinity;
  let offset = Infinity; // the station's clock against ours, by the quickest message
  let late = 0;
  let drawing = false;

  function forget() {
    Object.assign(live, fresh(), { n: 0, flight: "" });
    seen = { log: 0, results: 0 };
    changes = nothing(true);
  }

  function draw() {
    if (drawing) return;
    drawing = true;
    requestAnimationFrame(() => {
      drawing = false;
      const now = changes;
      changes = nothing(false);
      live.changed.ring(now);
    });
  }

  function take(message) {
    const another = live.server !== null && message.server !== live.server;
    live.server = message.server;
    if (another) { // what it counts is not what the one before counted: ask for everything
      forget();
      offset = Infinity;
      live.other.ring();
      return;
    }
    if (message.flight !== live.flight) forget();
    const { flight, n, made, state } = message;
    Object.assign(live, { flight, n, made, state });
    const way = Date.now() - made;
    offset = Math.min(offset, way);
    late = way - offset;
    heard = performance.now();
    for (const [kind, key] of [["missions", "name"], ["drones", "id"]]) {
      for (const row of message[kind]) {
        live[kind].set(row[key], row);
        changes[kind].add(row[key]);
      }
    }
    for (const kind of ["log", "results"]) {
      const lines = message[kind];
      for (const list of [live[kind], changes[kind]]) {
        list.push(...lines);
        if (list.length > KEPT * 1.2) list.splice(0, list.length - KEPT);
      }
      if (lines.length) [seen[kind]] = lines.at(-1);
    }
    draw();
  }

  live.age = () => performance.now() - heard + late;
  live.lost = () => live.age() > 3000;
  live.start = () =>
    keepOn(() => ({ flight: live.flight, seen: live.n, ...seen }), take, live.denied.ring);
  return live;
}
