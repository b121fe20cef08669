// What a heat map shows between the places of measurements: the formula of tests/library/station/results/heat.py, of which
// tests/library/station/results/vectors.json has examples for both; and its colours, viridis, which keeps its
// order for the colour-blind and in grey. Pure.

import { numberOf, placeOf } from "./layers.js";

/** @typedef {readonly [number, number, number]} Colour red, green and blue, from 0 to 255 */

/** @type {readonly Colour[]} viridis in equal steps, dark is low */
const STOPS = [
  [68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128],
  [94, 201, 98], [173, 220, 48], [253, 231, 37],
];

/** Colours of things that are of different kinds: Okabe and Ito's, which the colour-blind tell apart. */
export const KINDS = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#5f5f5f"];

/** The colour of a share of the range; what is beyond an end has that end's. @param {number} share @returns {Colour} */
export function colourAt(share) {
  const at = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const from = Math.min(Math.floor(at), STOPS.length - 2);
  const [low, high] = [STOPS[from], STOPS[from + 1]];
  const mix = (/** @type {0 | 1 | 2} */ part) => Math.round(low[part] + (high[part] - low[part]) * (at - from));
  return [mix(0), mix(1), mix(2)];
}

/** The share of a range at which a value lies; a range of no width has everything in its middle. @param {number} value @param {{ low: number, high: number }} range */
export const shareOf = (value, { low, high }) => (high > low ? (value - low) / (high - low) : 0.5);

/** @param {Colour} colour */
export const css = ([red, green, blue]) => `rgb(${red} ${green} ${blue})`;

/** The scale as a gradient of CSS, from left to right. */
export const gradient = `linear-gradient(to right, ${STOPS.map(css).join(", ")})`;

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
