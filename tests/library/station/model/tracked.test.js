// What moves beside the drones, in words: a screen never shows as known what is not known.

import "./browser.js";
import assert from "node:assert/strict";
import { test } from "node:test";
import { World } from "../../../../runtime/pluto_fleet/station/pages/core/world.js";

const { followed, trackNames } = await import("../../../../runtime/pluto_fleet/station/pages/map/tracked.js");

/** @type {any} */
const STATE = { phase: "flying", plan: 1, map: 0, said: "", how: null, busy: "" };
/** @type {any} */
const ROW = { id: "t1", kind: "fork_lift", x: 1, y: 2, z: 0, seen: 10, trail: [] };

/** @param {number} time @param {any} [more] */
function at(time, more) {
  const world = new World();
  world.take({ flight: "f", state: { ...STATE, time }, tracks: [ROW], ...more });
  return world;
}

test("what was just reported is called by its kind and its name", () => {
  const [label] = trackNames(at(12));
  assert.deepEqual([label.text, label.kind], ["fork lift t1", "tracked"]);
});

test("what was not reported for a while is another label, by which it is not taken for known", () => {
  const [label] = trackNames(at(40));
  assert.equal(label.kind, "old");
  assert.equal(label.text, "fork lift t1, seen 30 s ago");
});

test("a drone follows what the trip follows that it flies now, and nothing after that", () => {
  const trips = [{ name: "1", track: "t1" }, { name: "2" }];
  const follows = (/** @type {number | null} */ current) => {
    const world = at(12, { missions: [{ name: "A", current, trips }], drones: [{ id: "cf1", mission: "A" }] });
    return followed(world, world.drones.get("cf1"));
  };
  assert.deepEqual([follows(0), follows(1), follows(null)], ["t1", undefined, undefined]);
  assert.equal(followed(at(12), undefined), undefined);
});
