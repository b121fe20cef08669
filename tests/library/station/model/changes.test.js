// Changes of a plan.

import assert from "node:assert/strict";
import { test } from "node:test";
import * as changes from "../../../../runtime/pluto_fleet/station/pages/core/changes.js";

/** @param {string} key @param {string} name @param {string[]} [trips] @returns {any} */
const mission = (key, name, trips = []) => ({
  key, name, launched: false, ended: null,
  trips: trips.map((trip) => ({ key: trip, action: "measure", target: [1, 2], parameters: {}, item: null })),
});
const PLAN = [mission("a", "Ward 1", ["t1", "t2"]), mission("b", "Ward 2")];

test("a change that is made twice is made once", () => {
  const add = changes.addMission("c", "Mission");
  assert.equal(add(add(PLAN)).length, 3);
  const copy = changes.copyMission("a", "c");
  assert.deepEqual(copy(copy(PLAN)), copy(PLAN));
});

test("a copy has a name and keys of its own, and nothing in common with its original", () => {
  const [, copy] = changes.copyMission("a", "c")(PLAN);
  assert.equal(copy.name, "Ward 3");
  assert.equal(copy.trips.length, 2);
  assert.ok(copy.trips.every(({ key }) => !["t1", "t2"].includes(key)));
  copy.trips[0].target = [9, 9];
  assert.deepEqual(PLAN[0].trips[0].target, [1, 2]);
});

test("what is changed is found by its key, wherever it is by then", () => {
  const change = changes.inTrips("a", (trips) => trips.map((trip) => (trip.key === "t2" ? { ...trip, target: [5, 5] } : trip)));
  const [, moved] = change(PLAN.toReversed());
  assert.deepEqual(moved.trips.map(({ target }) => target), [[1, 2], [5, 5]]);
  assert.deepEqual(change([PLAN[1]]), [PLAN[1]]);
});

test("a mission that flies is not removed", () => {
  const flying = [{ ...PLAN[0], launched: true }];
  assert.deepEqual(changes.removeMission("a")(flying), flying);
});

test("each value of a plan has one place", () => {
  const leaves = changes.leaves(PLAN);
  assert.equal(leaves.get("a name"), "Ward 1");
  assert.equal(leaves.get("a t2 target 1"), "2");
});
