// Where a picture lies by its world file.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { degrees, onMap } from "../../../../runtime/pluto_fleet/station/pages/core/earth.js";
import { isWorldFile, placed, toMap } from "../../../../runtime/pluto_fleet/station/pages/places/world_file.js";

const EXAMPLES = JSON.parse(readFileSync(new URL("../map/earth.json", import.meta.url), "utf-8"));
const same = (/** @type {readonly number[]} */ place) => place;

test("degrees become the place of the map that has them, to a millimetre within two kilometres", () => {
  for (const { plane, place } of EXAMPLES) {
    const near = place.slice(0, 2).map((/** @type {number} */ one) => one / 10);
    const found = onMap(plane, degrees(plane, near));
    for (const axis of [0, 1]) assert.ok(Math.abs(found[axis] - near[axis]) < 1e-3, `${found} is not ${near}`);
  }
});

test("on a map on the Earth the first number of a place is its longitude, and what is not in degrees has no place", () => {
  const [{ plane, place, degrees: [latitude, longitude] }] = EXAMPLES;
  const [x, y] = /** @type {number[]} */ (toMap(plane)([longitude, latitude]));
  assert.ok(Math.hypot(x - place[0], y - place[1]) < 1e-3);
  assert.equal(toMap(plane)([512345, 5034567]), null);
  assert.deepEqual(toMap(null)([512345, 5034567]), [512345, 5034567]);
});

test("the middle of the first pixel is at the last two numbers, and rows go down", () => {
  const found = placed("0.5\n0\n0\n-0.5\n10.25\n29.75\n", { width: 40, height: 20 }, same);
  assert.deepEqual(found, { x: 10, y: 20, width: 20, height: 10, turn: -0 });
});

test("a picture that is turned to the right stays as large as it is", () => {
  const found = placed("0 -2 -2 0 0 0", { width: 3, height: 1 }, same);
  assert.ok(found);
  assert.deepEqual([found.width, found.height, Math.round(found.turn)], [6, 2, 90]);
  assert.deepEqual([found.x, found.y], [-1, 1]);
});

test("what is no world file, seen in a mirror, or not on the map has no place", () => {
  for (const text of ["", "1 0 0 -1 0", "1 0 0 -1 0 0 0", "a 0 0 -1 0 0", "1 0 0 1 0 0"]) {
    assert.equal(placed(text, { width: 2, height: 2 }, same), null, text);
  }
  assert.equal(placed("1 0 0 -1 0 0", { width: 2, height: 2 }, () => null), null);
});

test("world files are known by their names", () => {
  assert.deepEqual(["f.pgw", "f.JGW", "f.wld", "f.pngw"].filter((one) => !isWorldFile(one)), []);
  assert.deepEqual(["f.png", "f.webp", "w.svg", "pgw"].filter(isWorldFile), []);
});
