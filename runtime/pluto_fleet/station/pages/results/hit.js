// What lies under the pointer: a pin or a value that is near, else the photo on top. Pure.

/** @import { PhotoOnMap, Pin } from "./layers.js" */

export const NEAR = 14; // pixels around what is small

/** @typedef {{ x: number, y: number, results: Result[] }} Spot a place with its results, the newest first */

/**
 * The results at a place, the newest first; none: nothing is there.
 * @param {At} at in metres
 * @param {number} scale pixels a metre
 * @param {{ pins: readonly Pin[], values: readonly Spot[], photos: readonly PhotoOnMap[] }} shown
 * @returns {Result[]}
 */
export function hit(at, scale, { pins, values, photos }) {
  let [nearest, found] = [NEAR, /** @type {Result[]} */ ([])];
  for (const { x, y, results } of [...pins, ...values]) {
    const distance = Math.hypot(at.x - x, at.y - y) * scale;
    if (distance < nearest) [nearest, found] = [distance, results];
  }
  if (found.length) return found;
  const photo = photos.findLast(({ x, y, width, height }) =>
    Math.abs(at.x - x) <= width / 2 && Math.abs(at.y - y) <= height / 2);
  return photo ? [photo.result] : [];
}

/** Results of numbers by their places, as the layer draws them. @param {readonly Result[]} results the oldest first @param {(result: Result) => readonly number[] | null} placeOf @returns {Spot[]} */
export function spotsOf(results, placeOf) {
  /** @type {Map<string, Spot>} */
  const spots = new Map();
  for (const result of results) {
    const place = placeOf(result);
    if (!place) continue;
    const [x, y] = place;
    const key = `${Math.round(x * 1000)} ${Math.round(y * 1000)}`;
    spots.set(key, { x, y, results: [result, ...spots.get(key)?.results ?? []] });
  }
  return [...spots.values()];
}
