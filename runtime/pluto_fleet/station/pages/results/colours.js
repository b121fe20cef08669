// The colours of a heat map: viridis, which keeps its order for the colour-blind and in grey. Pure.

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
