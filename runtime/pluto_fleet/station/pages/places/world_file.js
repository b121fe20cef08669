// Where a picture lies that has a world file: six numbers, a line each, which make of a pixel a place. Pure.

import { onMap } from "../core/earth.js";

/** @import { Placement } from "./calibration.js" */

const SIX = 6;

/** Whether a file's name is one of a world file: .pgw, .jgw, .tfw, .pngw, .wld. @param {string} name */
export const isWorldFile = (name) => /\.(\w+w|wld)$/i.test(name);

/** What makes of a place of the file one in metres of a map, which may lie on the Earth; null: it is none. @param {Plane | null} plane */
export const toMap = (plane) => (/** @type {readonly [number, number]} */ [x, y]) => {
  if (!plane) return [x, y];
  return Math.abs(x) <= 180 && Math.abs(y) <= 90 ? onMap(plane, [y, x]) : null;
};

/**
 * Where the picture lies on the map; null: the file does not say it.
 * @param {string} text of the world file @param {{ width: number, height: number }} pixels of the picture
 * @param {(place: readonly [number, number]) => readonly number[] | null} at a place of the file in metres of the map; null: it is none
 * @returns {Placement | null}
 */
export function placed(text, { width, height }, at) {
  const numbers = text.trim().split(/\s+/).map((one) => Number(one.replace(",", ".")));
  if (numbers.length !== SIX || !numbers.every(Number.isFinite)) return null;
  const [right, turnedY, turnedX, down, x, y] = numbers; // x and y are those of the middle of the first pixel
  const corner = (/** @type {number} */ column, /** @type {number} */ row) => at([
    x + right * (column - 0.5) + turnedX * (row - 0.5), y + turnedY * (column - 0.5) + down * (row - 0.5)]);
  const corners = [corner(0, 0), corner(width, 0), corner(0, height)];
  if (corners.some((one) => one === null)) return null;
  const [upper, end, lower] = /** @type {number[][]} */ (corners);
  const [wide, high] = [[end[0] - upper[0], end[1] - upper[1]], [upper[0] - lower[0], upper[1] - lower[1]]];
  const isUpright = wide[0] * high[1] - wide[1] * high[0] > 0; // and not seen in a mirror
  return isUpright ? {
    x: lower[0], y: lower[1], width: Math.hypot(wide[0], wide[1]), height: Math.hypot(high[0], high[1]),
    turn: -Math.atan2(wide[1], wide[0]) * (180 / Math.PI),
  } : null;
}
