// What of the map is seen.

import assert from "node:assert/strict";
import { test } from "node:test";
import { calibrated } from "../../../../runtime/pluto_fleet/station/pages/places/calibration.js";
import * as view from "../../../../runtime/pluto_fleet/station/pages/map/view.js";

const BOX = { width: 1000, height: 600 };
const SIZE = /** @type {const} */ ([18, 10]);

/** A row of numbers that look random and are the same each time. */
function* numbers(seed = 7) {
  for (let now = seed; ;) yield (now = (now * 48271) % 2147483647) / 2147483647;
}

test("the whole map is inside of its box", () => {
  const { left, bottom, scale } = view.whole(BOX, SIZE);
  assert.ok(left > 0 && left + SIZE[0] * scale < BOX.width);
  assert.ok(bottom < BOX.height && bottom - SIZE[1] * scale > 0);
});

test("a pixel is the place that is drawn there", () => {
  const seen = view.whole(BOX, SIZE);
  const { x, y } = view.toMetres(seen, view.toPixels(seen, 3.25, 7.5));
  assert.ok(Math.abs(x - 3.25) < 1e-9 && Math.abs(y - 7.5) < 1e-9);
});

test("however the map is zoomed and moved, the middle of the box is on it", () => {
  const random = numbers();
  const next = () => /** @type {number} */ (random.next().value);
  let seen = view.whole(BOX, SIZE);
  for (let i = 0; i < 500; i += 1) {
    seen = view.zoomed(seen, 0.5 + next() * 1.5, { x: next() * 1000, y: next() * 600 }, BOX, SIZE);
    seen = view.kept({ ...seen, left: seen.left + next() * 800 - 400, bottom: seen.bottom + next() * 800 - 400 }, BOX, SIZE);
    const { x, y } = view.toMetres(seen, { x: 500, y: 300 });
    assert.ok(x >= -1e-6 && x <= SIZE[0] + 1e-6 && y >= -1e-6 && y <= SIZE[1] + 1e-6);
  }
});

test("what a zoom is over stays where it is", () => {
  const seen = view.zoomed(view.whole(BOX, SIZE), 4, { x: 480, y: 310 }, BOX, SIZE);
  const before = view.toMetres(seen, { x: 480, y: 310 });
  const after = view.toMetres(view.zoomed(seen, 1.5, { x: 480, y: 310 }, BOX, SIZE), { x: 480, y: 310 });
  assert.ok(Math.hypot(before.x - after.x, before.y - after.y) < 1e-9);
});

test("a place behind a wall, or beyond the map, cannot be flown to", () => {
  const map = { size: SIZE, no_fly: [[[6, 0], [6.2, 0], [6.2, 4], [6, 4]]] };
  assert.equal(view.whyNot(map, [6.1, 2]), "map.in-no-fly");
  assert.equal(view.whyNot(map, [-0.1, 2]), "map.outside");
  assert.equal(view.whyNot(map, [5.9, 2]), "");
});

test("a floor plan becomes so large that two of its points are so far apart, and the first stays where it is", () => {
  const laid = { x: 1, y: 2, width: 10, height: 5, turn: 30 };
  const first = { x: 3, y: 4 };
  const now = calibrated(laid, first, { x: 6, y: 8 }, 10);
  assert.deepEqual(now, { x: -1, y: 0, width: 20, height: 10, turn: 30 });
  assert.deepEqual(calibrated(now, first, { x: 9, y: 12 }, 5), laid);
});

const SEEN = { left: 0, bottom: 600, scale: 50 }; // 20 by 12 metres
const at = (/** @type {number[]} */ place) => place;
const square = Array.from({ length: 400 }, (_, n) => [n % 20 + 0.5, Math.floor(n / 20) + 0.5]);

test("of many places those have marks that are in view, unless they are too many themselves", () => {
  const few = square.slice(0, view.MOST_MARKS);
  assert.equal(view.marksOf(few, at, { ...SEEN, left: -9000 }, BOX), few);
  assert.deepEqual(view.marksOf(square, at, { ...SEEN, bottom: 300 }, BOX), square.filter(([, y]) => y < 7));
  assert.deepEqual(view.marksOf(square, at, { ...SEEN, bottom: 900 }, BOX), []);
});

test("a press is meant for the nearest place, and for none if all are far", () => {
  assert.equal(view.nearest(square, at, { x: 3.4, y: 2.7 }, 0.3), square[43]);
  assert.equal(view.nearest(square, at, { x: 4, y: 3 }, 0.3), null);
});
