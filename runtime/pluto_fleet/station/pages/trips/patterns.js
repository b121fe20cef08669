// Many places at once: a row along a line, a grid and the lanes of a sweep over a rectangle. Pure.

import { rounded } from "./snapping.js";

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
