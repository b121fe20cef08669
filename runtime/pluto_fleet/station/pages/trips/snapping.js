// Where pins go: one that is held somewhere, to a named place nearby, else to a round coordinate; and many at once,
// in a row along a line or a grid over a rectangle. Pure.

const STEP = 0.1; // metres
const FINE = 0.01;
const NEAR = 0.5; // of a named place

/** @param {number} value @param {number} [step] */
export const rounded = (value, step = FINE) => Number((Math.round(value / step) * step).toFixed(2));

/** The nearest of the places that is near. @param {At} at @param {readonly Place[]} places */
export function placeNear({ x, y }, places) {
  const far = (/** @type {Place} */ one) => Math.hypot(one.x - x, one.y - y);
  const [nearest] = places.filter((one) => far(one) < NEAR).toSorted((a, b) => far(a) - far(b));
  return nearest ?? null;
}

/** @param {At} at @param {boolean} fine to the centimetre, and to no place @param {readonly Place[]} places @returns {[number, number]} */
export function snapped(at, fine, places) {
  const place = fine ? null : placeNear(at, places);
  if (place) return [place.x, place.y];
  const step = fine ? FINE : STEP;
  return [rounded(at.x, step), rounded(at.y, step)];
}

/** The place that lies just there. @param {readonly number[]} target @param {readonly Place[]} places */
export const placeAt = ([x, y], places) =>
  places.find((one) => Math.abs(one.x - x) < FINE / 2 && Math.abs(one.y - y) < FINE / 2) ?? null;

/** @typedef {[number, number]} Target */

/** So many places from one point to another, both of them included. @param {At} from @param {At} to @param {number} count @returns {Target[]} */
export function row(from, to, count) {
  return Array.from({ length: count }, (_, n) => {
    const share = count > 1 ? n / (count - 1) : 0;
    return [rounded(from.x + (to.x - from.x) * share), rounded(from.y + (to.y - from.y) * share)];
  });
}

/** Columns and rows between two corners; every other row goes back, so that the way is short. @param {At} from @param {At} to @param {number} columns @param {number} rows @returns {Target[]} */
export function grid(from, to, columns, rows) {
  return row({ x: 0, y: from.y }, { x: 0, y: to.y }, rows).flatMap(([, y], n) => {
    const places = row({ x: from.x, y }, { x: to.x, y }, columns);
    return n % 2 ? places.reverse() : places;
  });
}
