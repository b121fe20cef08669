import assert from "node:assert/strict";
import { test } from "node:test";
import { World } from "../../../../runtime/pluto_fleet/station/pages/core/world.js";
import { ALL, choices, filtered, sorted, windowOf } from "../../../../runtime/pluto_fleet/station/pages/results/table_model.js";

const row = (number, some = {}) => {
  const { what = "Photo", value = "", place = "", mission = "M", tags = [], quantity } = some;
  return {
    result: { number, time: number, mission, place: place || null, tags, values: quantity === undefined ? [] : [{ quantity: what, value: quantity, unit: "" }] },
    words: { time: String(number), what, value, place, mission, trip: "", drone: "" },
    text: [what, value, place, mission, ...tags].join(" ").toLowerCase(),
  };
};
const numbers = (rows) => rows.map(({ result }) => result.number);

test("rows are searched by every word, and filtered by all that is chosen", () => {
  const rows = [
    row(1, { what: "Temperature", value: "21 °C", place: "Bed 3" }), row(2, { tags: ["pest"], place: "Bed 3" }),
    row(3, { tags: ["pest", "bloom"], mission: "North" }),
  ];
  assert.deepEqual(numbers(filtered(rows, ALL)), [1, 2, 3]);
  assert.deepEqual(numbers(filtered(rows, { ...ALL, text: "bed 21" })), [1]);
  assert.deepEqual(numbers(filtered(rows, { ...ALL, tag: "pest", mission: "North" })), [3]);
  assert.deepEqual(numbers(filtered(rows, { ...ALL, place: "Bed 3", what: "Photo" })), [2]);
  assert.deepEqual(choices(rows, ({ result }) => result.tags), ["bloom", "pest"]);
});

test("numbers are sorted as numbers, names by their numbers, and what is missing comes last either way", () => {
  const rows = [row(1, { value: "100", quantity: 100 }), row(2, { value: "9", quantity: 9 }), row(3), row(4, { value: "yes" })];
  assert.deepEqual(numbers(sorted(rows, { column: "value", down: false })), [2, 1, 4, 3]);
  assert.deepEqual(numbers(sorted(rows, { column: "value", down: true })), [4, 1, 2, 3]);
  const beds = [row(1, { place: "Bed 10" }), row(2, { place: "Bed 9" }), row(3)];
  assert.deepEqual(numbers(sorted(beds, { column: "place", down: false })), [2, 1, 3]);
  assert.deepEqual(numbers(sorted(beds, { column: "place", down: true })), [1, 2, 3]);
});

test("of five thousand rows those are drawn that are seen, and a few around them", () => {
  assert.deepEqual(windowOf(0, 400, 40, 5000), { first: 0, last: 18 });
  assert.deepEqual(windowOf(100_000, 400, 40, 5000), { first: 2492, last: 2518 });
  assert.deepEqual(windowOf(199_600, 400, 40, 5000), { first: 4982, last: 5000 });
  assert.deepEqual(windowOf(500, 400, 40, 3), { first: 3, last: 3 });
});

test("a list that got only the newest entries is whole again with those that it missed", () => {
  const { results } = new World();
  const entries = (from, to) => Array.from({ length: to - from + 1 }, (_, at) => ({ number: from + at }));
  assert.equal(results.isWhole, true);
  results.take(entries(301, 800));
  assert.equal(results.isWhole, false);
  results.fill(entries(1, 790));
  assert.equal(results.isWhole, true);
  assert.deepEqual(results.entries.value, entries(1, 800));
  results.take(entries(801, 6000));
  assert.deepEqual([results.isWhole, results.entries.value.length, results.last], [true, 5000, 6000]);
});
