// The formulas of station/results, held to the same examples as those: tests/library/station/results/vectors.json.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Field, heatAt, newest } from "../../../../runtime/pluto_fleet/station/pages/results/heat.js";
import { hit } from "../../../../runtime/pluto_fleet/station/pages/results/layers.js";
import { photosOf } from "../../../../runtime/pluto_fleet/station/pages/results/layers.js";

const VECTORS = JSON.parse(readFileSync(new URL("../results/vectors.json", import.meta.url), "utf-8"));

const sampled = ([x, y, value]) => ({ x, y, value });
const near = (got, wanted, what) => (wanted === null
  ? assert.equal(got, null, what)
  : assert.ok(got !== null && Math.abs(got - wanted) <= 1e-9 * Math.max(1, Math.abs(wanted)), `${what}: ${got}, not ${wanted}`));

test("a heat map is what the station's own formula says, looked up in cells or not", () => {
  assert.ok(VECTORS.heat.length > 10);
  for (const { what, samples, reach, at: [x, y], value } of VECTORS.heat) {
    const given = samples.map(sampled);
    near(heatAt(given, x, y, reach), value, what);
    near(new Field(given, reach).at(x, y), value, what);
  }
});

test("of several values at a place the one that the station takes counts", () => {
  for (const { samples, kept } of VECTORS.newest) {
    const order = (all) => all.toSorted((a, b) => a.x - b.x || a.y - b.y);
    assert.deepEqual(order(newest(samples.map(sampled))), order(kept.map(sampled)));
  }
});

test("the photo on top is the one that the station says", () => {
  assert.ok(VECTORS.mosaic.length > 3);
  for (const { what, photos: taken, at: [x, y], on_top: wanted } of VECTORS.mosaic) {
    const photos = photosOf(taken.map(({ number, ...value }) => ({ number, value })));
    const [found] = hit({ x, y }, 40, { pins: [], values: [], photos });
    assert.equal(found?.number ?? null, wanted, what);
  }
});
