import assert from "node:assert/strict";
import { test } from "node:test";
import { colourAt, shareOf } from "../../../../runtime/pluto_fleet/station/pages/results/heat.js";
import { Field, heatAt, newest, pixelsOf, rasterOf, samplesOf } from "../../../../runtime/pluto_fleet/station/pages/results/heat.js";
import { hit, spotsOf } from "../../../../runtime/pluto_fleet/station/pages/results/layers.js";
import {
  countsOf, layersOn, photosOf, pinsOf, shownLayers,
} from "../../../../runtime/pluto_fleet/station/pages/results/layers.js";

const NOTHING = { title: null, quantity: null, unit: null, low: null, high: null, reach: null };
const MEASURE = { ...NOTHING, id: "measure", action: "measure", kind: "heat", reach: 3 };
const DUST = { ...MEASURE, id: "measure:pm10", quantity: "pm10", unit: "µg/m³", high: 100 };
const PHOTOS = { ...NOTHING, id: "take_photo:photos", action: "take_photo", kind: "photos" };

let number = 0;
const result = (some) => ({
  number: number += 1, time: number, mission: "M", trip: null, round: null, attempt: null, drone: null,
  kind: "result", action: null, parameters: {}, target: [1, 1, 1], at: null, place: null, value: null,
  values: [], tags: [], layers: [], ...some,
});
const measured = (quantity, value, at, layers = ["measure"]) =>
  result({ kind: "measurement", values: [{ quantity, value, unit: "°C" }], target: at, layers });
const photo = (sharpness, position, sees = []) => result({
  kind: "photo", target: position, tags: sees, layers: ["take_photo:photos", "take_photo:findings"],
  value: { position, width: 4, height: 3, sees, sharpness, picture: null },
});

test("a layer that stands for all quantities becomes one for each that was measured", () => {
  const layers = shownLayers([DUST, MEASURE, PHOTOS], [
    measured("temperature", 20, [1, 1]), measured("noise", 3, [2, 1]), measured("temperature", 22, [3, 1]),
  ]);
  assert.deepEqual(layers.map(({ id, quantity, range, results }) => [id, quantity, range, results.length]), [
    ["measure:pm10", "pm10", null, 0],
    ["measure:temperature", "temperature", { low: 20, high: 22 }, 2],
    ["measure:noise", "noise", { low: 3, high: 3 }, 1],
    ["take_photo:photos", null, null, 0],
  ]);
});

test("what the app says of the ends of the colours counts, and what was measured where it says nothing", () => {
  const [layer] = shownLayers([DUST], [measured("pm10", 12, [1, 1], ["measure:pm10"])]);
  assert.deepEqual(layer.range, { low: 12, high: 100 });
});

test("all layers are on but the heat maps after the first that has values, unless the reader chose", () => {
  const layers = shownLayers([DUST, MEASURE, PHOTOS], [measured("a", 1, [1, 1]), measured("b", 1, [1, 1])]);
  assert.deepEqual([...layersOn(layers, {})], ["measure:a", "take_photo:photos"]);
  assert.deepEqual([...layersOn(layers, { "measure:b": true, "measure:a": false })], ["measure:b", "take_photo:photos"]);
});

test("a pin has what the newest photo of its place shows, and all that showed any", () => {
  const [first, second, other] = [
    photo(1, [2, 2, 1], ["bloom", "bloom", "pest"]), photo(1, [2.05, 2, 1], ["bloom"]), photo(1, [6, 2, 1], ["bloom"]),
  ];
  const pins = pinsOf([first, second, other]);
  assert.deepEqual(pins.map(({ tag, x, count, results }) => [tag, x, count, results.map((one) => one.number)]), [
    ["bloom", 2.05, 1, [second.number, first.number]],
    ["pest", 2, 1, [first.number]],
    ["bloom", 6, 1, [other.number]],
  ]);
  assert.deepEqual(countsOf(pins), [{ tag: "bloom", count: 2, places: 2 }, { tag: "pest", count: 1, places: 1 }]);
});

test("the sharpest photo lies on top, of equals the newest, and is the one that is hit", () => {
  const [blurred, sharp, later] = [photo(0.4, [2, 2, 1]), photo(1, [2, 2, 1]), photo(0.5, [3, 2, 1])];
  const photos = photosOf([sharp, blurred, later]);
  assert.deepEqual(photos.map((one) => one.result), [blurred, later, sharp]);
  const shown = { pins: [], values: [], photos };
  assert.deepEqual(hit({ x: 2.5, y: 2 }, 40, shown), [sharp]);
  assert.deepEqual(hit({ x: 4.9, y: 2 }, 40, shown), [later]);
  assert.deepEqual(hit({ x: 9, y: 9 }, 40, shown), []);
});

test("a value near the pointer comes before the photo under it, with those measured there before", () => {
  const [before, now] = [measured("a", 1, [2, 2]), measured("a", 2, [2, 2])];
  const values = spotsOf([before, now]);
  assert.deepEqual(hit({ x: 2.1, y: 2 }, 40, { pins: [], values, photos: photosOf([photo(1, [2, 2, 1])]) }), [now, before]);
});

test("of several values at a place the last one counts, and none beyond its reach", () => {
  const samples = newest([{ x: 1, y: 1, value: 5 }, { x: 1.0001, y: 1, value: 7 }]);
  assert.equal(heatAt(samples, 1, 1, 3), 7);
  assert.equal(heatAt(samples, 4.01, 1, 3), null);
  assert.equal(heatAt([{ x: 0, y: 0, value: 10 }, { x: 2, y: 0, value: 20 }], 1, 0, 3), 15);
});

test("the cells of a field leave out no sample that speaks for a point", () => {
  const samples = Array.from({ length: 60 }, (_, n) => ({ x: (n * 7.3) % 12, y: (n * 3.1) % 9, value: n }));
  const field = new Field(samples, 2.5);
  for (let n = 0; n < 100; n += 1) {
    const [x, y] = [(n * 1.7) % 12, (n * 2.3) % 9];
    const [near, all] = [field.at(x, y), heatAt(samples, x, y, 2.5)];
    if (all === null) assert.equal(near, null);
    else assert.ok(Math.abs(near - all) < 1e-9 * Math.abs(all) + 1e-12);
  }
});

test("each pixel of a heat map has the colour of the value in its middle, or none where that is unknown", () => {
  const [layer] = shownLayers([{ ...MEASURE, reach: 2, low: 0, high: 10 }], [
    measured("a", 2, [1, 1]), measured("a", 9, [3, 1.5]),
  ]);
  const [size, field] = [[8, 4], new Field(samplesOf(layer), layer.reach)];
  const { width, height, data } = rasterOf(field, size, layer.range);
  assert.deepEqual([width, height], Object.values(pixelsOf(size, 2, 2)));
  let unknown = 0;
  for (let row = 0; row < height; row += 1) {
    for (let column = 0; column < width; column += 1) {
      const value = field.at(((column + 0.5) * 8) / width, 4 - ((row + 0.5) * 4) / height);
      const pixel = [...data.slice((row * width + column) * 4, (row * width + column) * 4 + 4)];
      unknown += value === null ? 1 : 0;
      assert.deepEqual(pixel, value === null ? [0, 0, 0, 0] : [...colourAt(shareOf(value, layer.range)), 255]);
    }
  }
  assert.ok(unknown > 0 && unknown < width * height);
});
