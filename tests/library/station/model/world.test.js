// What is known of a flight.

import assert from "node:assert/strict";
import { test } from "node:test";
import { effect } from "../../../../runtime/node_modules/@preact/signals-core/dist/signals-core.mjs";
import { World } from "../../../../runtime/pluto_fleet/station/pages/core/world.js";

/** @type {any} */
const STATE = { phase: "flying", time: 3, plan: 1, map: 0, said: "", how: null, busy: "" };
/** @param {string} name @param {object} [more] @returns {any} */
const mission = (name, more) => ({ name, index: 0, status: "RUNNING", trips: [], ...more });

test("a row that changes is told to those who read it, and to no others", () => {
  const world = new World();
  world.take({ flight: "f", state: STATE, missions: [mission("A"), mission("B")] });
  let reads = 0;
  effect(() => {
    world.missions.get("A");
    reads += 1;
  });
  world.take({ flight: "f", state: STATE, missions: [mission("B", { status: "COMPLETED" })] });
  assert.equal(reads, 1);
  world.take({ flight: "f", state: STATE, missions: [mission("A", { status: "COMPLETED" })] });
  assert.equal(reads, 2);
  assert.deepEqual(world.missions.keys.value, ["A", "B"]);
});

test("a row that was not there, or of a flight that is over, is told as it comes", () => {
  const world = new World();
  /** @type {(string | undefined)[]} */
  const seen = [];
  effect(() => { seen.push(world.missions.get("A")?.status); });
  world.take({ flight: "f", state: STATE, missions: [mission("A")] });
  world.take({ flight: "g", state: STATE, missions: [mission("A", { status: "UNEXECUTED" })] });
  world.clear();
  world.take({ flight: "h", state: STATE, missions: [mission("A", { status: "PAUSED" })] });
  assert.deepEqual(seen, [undefined, "RUNNING", "UNEXECUTED", undefined, "PAUSED"]);
});

test("another flight has nothing of the one before", () => {
  const world = new World();
  /** @type {any[]} */
  const log = [{ number: 1, time: 0, mission: null, text: "begun", kind: "info" }];
  world.take({ flight: "f", state: STATE, missions: [mission("A")], log });
  world.take({ flight: "g", state: STATE, missions: [mission("B")] });
  assert.deepEqual(world.missions.keys.value, ["B"]);
  assert.deepEqual(world.log.entries.value, []);
});

test("a line that comes twice is there once", () => {
  const world = new World();
  /** @type {any[]} */
  const log = [1, 2, 3].map((number) => ({ number, time: 0, mission: null, text: "x", kind: "info" }));
  world.take({ flight: "f", state: STATE, log });
  world.take({ flight: "f", state: STATE, log: [...log, { ...log[0], number: 4 }] });
  assert.deepEqual(world.log.entries.value.map(({ number }) => number), [1, 2, 3, 4]);
});

test("what is known of a result later stands in its place, and brings none that is not here", () => {
  const world = new World();
  /** @type {any[]} */
  const results = [1, 2].map((number) => ({ number, drained: null }));
  world.take({ flight: "f", state: STATE, results });
  world.take({ flight: "f", state: STATE, amended: [{ ...results[0], drained: 0.07 }, { ...results[0], number: 3 }] });
  assert.deepEqual(world.results.entries.value, [{ number: 1, drained: 0.07 }, results[1]]);
  assert.equal(world.results.last, 2);
});

test("until the station has spoken, nothing is known", () => {
  const world = new World();
  assert.equal(world.state.value.known, false);
  world.take({ state: STATE });
  assert.equal(world.state.value.known, true);
});

/** @param {string} id @param {number} x @returns {any} */
const track = (id, x) => ({ id, kind: "person", x, y: 0, z: 0, seen: 1, trail: [] });

test("what is not tracked any more is gone, and what is not said stays", () => {
  const world = new World();
  world.take({ flight: "f", state: STATE, tracks: [track("t1", 1), track("t2", 2)] });
  world.take({ flight: "f", state: STATE });
  assert.deepEqual(world.tracks.keys.value, ["t1", "t2"]);
  world.take({ flight: "f", state: STATE, tracks: [track("t2", 3)] });
  assert.deepEqual(world.tracks.all().map(({ id, x }) => [id, x]), [["t2", 3]]);
});

test("of many events the newest are kept, and one of which more is known has the same place", () => {
  const world = new World();
  const event = (/** @type {number} */ number) => (/** @type {any} */ ({ id: `e${number}`, time: number, made: [] }));
  world.take({ flight: "f", state: STATE, events: Array.from({ length: 700 }, (_, at) => event(at)) });
  world.take({ flight: "f", state: STATE, events: [{ ...event(699), made: ["Look"] }] });
  const all = world.events.all();
  assert.deepEqual([all.length, all[0].id, all.at(-1)?.made], [500, "e200", ["Look"]]);
});
