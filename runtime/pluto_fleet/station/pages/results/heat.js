// What a heat map shows between the places of measurements: the formula of station/results/heat.py, of
// which tests/station/results/vectors.json has examples for both. Pure.

import { colourAt, shareOf } from "./colours.js";
import { numberOf, placeOf } from "./layers.js";

/** @import { ShownLayer } from "./layers.js" */

/** @typedef {{ x: number, y: number, value: number }} Sample in metres */
/** @typedef {{ width: number, height: number, data: Uint8ClampedArray<ArrayBuffer> }} Raster in pixels, red, green, blue and opacity of each, the northernmost row first */

const SAME_PLACE = 0.001; // metres within which two places are one

/** One sample for each place, the last one given; places are told apart by millimetres. @param {Iterable<Sample>} samples @returns {Sample[]} */
export function newest(samples) {
  /** @type {Map<string, Sample>} */
  const kept = new Map();
  for (const sample of samples) kept.set(`${Math.round(sample.x * 1000)} ${Math.round(sample.y * 1000)}`, sample);
  return [...kept.values()];
}

/** The samples of a layer, one for each place. @param {ShownLayer} layer */
export const samplesOf = ({ results, quantity }) => newest(results.flatMap((result) => {
  const [place, number] = [placeOf(result), numberOf(result, quantity)];
  return place && number ? [{ x: place[0], y: place[1], value: number.value }] : [];
}));

/**
 * The value of a heat map at a point; null: unknown, no sample is within its reach. A sample at a
 * distance d weighs (1/d - 1/reach)²: all at its own place, and nothing at its reach.
 * @param {Iterable<Sample>} samples one for each place
 * @param {number} x @param {number} y @param {number} reach metres
 * @returns {number | null}
 */
export function heatAt(samples, x, y, reach) {
  let [weights, total, nearest] = [0, 0, SAME_PLACE];
  /** @type {number | null} */
  let there = null;
  for (const sample of samples) {
    const distance = Math.hypot(x - sample.x, y - sample.y);
    if (distance <= nearest) {
      [nearest, there] = [distance, sample.value];
    } else if (distance < reach) {
      const weight = (1 / distance - 1 / reach) ** 2;
      weights += weight;
      total += weight * sample.value;
    }
  }
  if (there !== null) return there;
  return weights ? total / weights : null;
}

/** Samples in cells as large as their reach, so that only those near a point are looked at. */
export class Field {
  /** @param {readonly Sample[]} samples one for each place @param {number} reach metres */
  constructor(samples, reach) {
    this.reach = reach;
    /** @type {Map<string, Sample[]>} */
    this.cells = new Map();
    for (const sample of samples) {
      const key = this.cell(sample.x, sample.y).join(" ");
      const others = this.cells.get(key);
      if (others) others.push(sample);
      else this.cells.set(key, [sample]);
    }
  }

  /** @param {number} x @param {number} y */
  cell(x, y) {
    return [Math.floor(x / this.reach), Math.floor(y / this.reach)];
  }

  /** The samples that may speak for a point. @param {number} x @param {number} y */
  near(x, y) {
    const [i, j] = this.cell(x, y);
    const steps = [-1, 0, 1];
    return steps.flatMap((di) => steps.flatMap((dj) => this.cells.get(`${i + di} ${j + dj}`) ?? []));
  }

  /** @param {number} x @param {number} y @returns {number | null} */
  at(x, y) {
    return heatAt(this.near(x, y), x, y, this.reach);
  }
}

const FINEST = 24; // pixels in a reach
const MOST = 240; // pixels along the longer side

/** How many pixels the raster of a map has: fine enough for its reach, and no finer. @param {readonly number[]} size metres @param {number} reach metres */
export function pixelsOf([width, height], reach) {
  const scale = Math.min(FINEST / reach, MOST / Math.max(width, height));
  return { columns: Math.max(1, Math.ceil(width * scale)), rows: Math.max(1, Math.ceil(height * scale)) };
}

/**
 * The picture of a heat map: each pixel has the colour of the value in its middle, and is transparent
 * where that is unknown.
 * @param {Field} field @param {readonly number[]} size of the map, in metres
 * @param {{ low: number, high: number }} range at the ends of the colours
 * @returns {Raster}
 */
export function rasterOf(field, size, range) {
  const { columns, rows } = pixelsOf(size, field.reach);
  const data = new Uint8ClampedArray(columns * rows * 4);
  const [across, up] = [size[0] / columns, size[1] / rows];
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const value = field.at((column + 0.5) * across, size[1] - (row + 0.5) * up);
      if (value !== null) {
        data.set([...colourAt(shareOf(value, range)), 255], (row * columns + column) * 4);
      }
    }
  }
  return { width: columns, height: rows, data };
}
