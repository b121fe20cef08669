// Names on the map, which avoid each other.

import assert from "node:assert/strict";
import { test } from "node:test";
import { LINE, placed } from "../../../../runtime/pluto_fleet/station/pages/map/labels.js";

const BOX = { width: 800, height: 500 };

/** @param {number} count @param {number} width of the heap in which they are */
const crowd = (count, width) => Array.from({ length: count }, (_, i) => ({
  key: `d${i}`, text: `drone ${i}`, importance: i % 4, always: i % 10 === 0,
  x: 100 + ((i * 37) % width), y: 100 + ((i * 53) % width),
}));

/** @param {{ left: number, top: number, width: number }} a @param {{ left: number, top: number, width: number }} b */
const overlap = (a, b) => a.left < b.left + b.width && b.left < a.left + a.width
  && a.top < b.top + LINE && b.top < a.top + LINE;

test("no two names cover each other, but for those that must be seen", () => {
  const found = placed(crowd(60, 300), BOX);
  found.forEach((one, i) => found.slice(i + 1).forEach((other) => {
    if (!one.always || !other.always) assert.ok(!overlap(one, other), `${one.key} ${other.key}`);
  }));
});

test("what must be seen is seen in any crowd, inside of the box", () => {
  const found = placed(crowd(60, 40), BOX);
  const must = found.filter(({ always }) => always);
  assert.equal(must.length, 6);
  for (const { left, top, width } of must) {
    assert.ok(left >= 0 && top >= 0 && left + width <= BOX.width && top + LINE <= BOX.height);
  }
});

test("the important ones come first", () => {
  const found = placed(crowd(60, 60).map((one) => ({ ...one, always: false })), BOX);
  const least = Math.min(...found.map(({ importance }) => importance));
  assert.ok(found.length < 60);
  assert.equal(found.filter(({ importance }) => importance === 3).length > 0, true);
  assert.ok(least >= 0);
  assert.equal(found[0].importance, 3);
});

test("a name outside of what is seen is left out, unless it must be seen", () => {
  const [far] = crowd(1, 10);
  assert.equal(placed([{ ...far, x: -50, always: false }], BOX).length, 0);
  assert.equal(placed([{ ...far, x: -50, always: true }], BOX).length, 1);
});
