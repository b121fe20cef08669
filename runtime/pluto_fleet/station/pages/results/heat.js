// What a heat map shows between the places of measurements: the formula of station/results/heat.py, of
// which tests/library/station/results/vectors.json has examples for both. Pure.

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
 * @param {readonly Sample[]} samples one for each place
 * @param {number} x @param {number} y @param {number} reach metres
 * @returns {number | null}
 */
export function heatAt(samples, x, y, reach) {
  let [weights, total, nearest] = [0, 0, SAME_PLACE];
  /** @type {number | null} */
  let there = null;
  for (const sample of samples) {
    const dx = x - sample.x;
    const dy = y - sample.y;
    const distance = Math.sqrt(dx * dx + dy * dy); // ten times as fast as hypot
    if (distance <= nearest) {
      nearest = distance;
      there = sample.value;
    } else if (distance < reach) {
      const share = 1 / distance - 1 / reach;
      const weight = share * share;
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
    this.count = samples.length;
    /** @type {Map<string, Sample[]>} */
    this.cells = new Map();
    /** @type {Map<string, Sample[]>} those of a cell and of all around it, once they were asked for */
    this.around = new Map();
    for (const sample of samples) {
      const key = `${Math.floor(sample.x / reach)} ${Math.floor(sample.y / reach)}`;
      const others = this.cells.get(key);
      if (others) others.push(sample);
      else this.cells.set(key, [sample]);
    }
  }

  /** The samples that may speak for a point. @param {number} x @param {number} y */
  near(x, y) {
    const [i, j] = [Math.floor(x / this.reach), Math.floor(y / this.reach)];
    const key = `${i} ${j}`;
    let found = this.around.get(key);
    if (!found) {
      const steps = [-1, 0, 1];
      found = steps.flatMap((di) => steps.flatMap((dj) => this.cells.get(`${i + di} ${j + dj}`) ?? []));
      this.around.set(key, found);
    }
    return found;
  }

  /** @param {number} x @param {number} y @returns {number | null} */
  at(x, y) {
    return heatAt(this.near(x, y), x, y, this.reach);
  }
}

const FINEST = 24; // pixels in a reach
const MOST = 240; // pixels along the longer side
const WORK = 6e6; // samples looked at for one picture: a tenth of a second

/**
 * How many pixels the raster of a map has: fine enough for its reach, and no finer; fewer where there
 * are so many samples that it would take long.
 * @param {readonly number[]} size metres @param {number} reach metres @param {number} count of samples
 */
export function pixelsOf([width, height], reach, count) {
  const near = Math.min(count, (count * 9 * reach * reach) / (width * height));
  const fast = Math.sqrt(WORK / (Math.max(1, near) * width * height));
  const scale = Math.min(FINEST / reach, MOST / Math.max(width, height), fast);
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
  const { columns, rows } = pixelsOf(size, field.reach, field.count);
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
