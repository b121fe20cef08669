// Where a pin goes that is held somewhere: to a named place nearby, else to a round coordinate. Pure.

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

/**
 * @param {At} at @param {boolean} fine to the centimetre, and to no place
 * @param {readonly Place[]} places
 * @returns {[number, number]}
 */
export function snapped(at, fine, places) {
  const place = fine ? null : placeNear(at, places);
  if (place) return [place.x, place.y];
  const step = fine ? FINE : STEP;
  return [rounded(at.x, step), rounded(at.y, step)];
}

/** The place that lies just there. @param {readonly number[]} target @param {readonly Place[]} places */
export const placeAt = ([x, y], places) =>
  places.find((one) => Math.abs(one.x - x) < FINE / 2 && Math.abs(one.y - y) < FINE / 2) ?? null;
