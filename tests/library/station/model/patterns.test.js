import assert from "node:assert/strict";
import { test } from "node:test";
import { grid, row } from "../../../../runtime/pluto_fleet/station/pages/trips/snapping.js";
import { placeNear, snapped } from "../../../../runtime/pluto_fleet/station/pages/trips/snapping.js";
import { linked } from "../../../../runtime/pluto_fleet/station/pages/trips/carried.js";

test("a row has both its ends, and the places between them evenly", () => {
  assert.deepEqual(row({ x: 0, y: 0 }, { x: 3, y: 1.5 }, 4), [[0, 0], [1, 0.5], [2, 1], [3, 1.5]]);
  assert.deepEqual(row({ x: 2, y: 3 }, { x: 9, y: 9 }, 1), [[2, 3]]);
});

test("a grid goes there and back, so that no trip is longer than the next place", () => {
  assert.deepEqual(grid({ x: 0, y: 0 }, { x: 2, y: 1 }, 3, 2), [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]]);
});

test("a pin snaps to a named place nearby, else to ten centimetres, and with Shift to one", () => {
  const places = [{ name: "Bed 1", x: 3.05, y: 8.5 }, { name: "Bed 2", x: 3.3, y: 8.5 }];
  assert.deepEqual(snapped({ x: 3.1, y: 8.2 }, false, places), [3.05, 8.5]);
  assert.deepEqual(snapped({ x: 3.104, y: 8.2 }, true, places), [3.1, 8.2]);
  assert.deepEqual(snapped({ x: 5.04, y: 2.16 }, false, places), [5, 2.2]);
  assert.equal(placeNear({ x: 3.05, y: 9 }, places), null);
});

test("what is put down is what was picked last before it", () => {
  const trip = (/** @type {string} */ key, /** @type {string} */ action, /** @type {any} */ item = null) =>
    ({ key, action, item, target: null, parameters: {} });
  const pills = { name: "pills", mass: "8 g" };
  const trips = [trip("a", "pick_item", pills), trip("b", "take_photo"), trip("c", "release_item"), trip("d", "release_item")];
  assert.deepEqual(linked(trips).map(({ item }) => item), [pills, null, pills, null]);
});
