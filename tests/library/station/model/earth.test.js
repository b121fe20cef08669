// Places on the Earth, held to the same examples as those of geodesy.py: tests/library/station/map/earth.json.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const { degrees } = await import("../../../../runtime/pluto_fleet/station/pages/core/earth.js");
const EXAMPLES = JSON.parse(readFileSync(new URL("../map/earth.json", import.meta.url), "utf-8"));

test("a place of the map is where geodesy.py says, to a tenth of a millimetre", () => {
  for (const { plane, place, degrees: expected } of EXAMPLES) {
    const found = degrees(plane, place);
    for (const axis of [0, 1]) assert.ok(Math.abs(found[axis] - expected[axis]) < 1e-9, `${found} is not ${expected}`);
  }
});
