// Where a floor plan lies, by two of its points and the length between them. Pure.
//
// A picture has its pixels counted from its upper left corner, x to the right and y down; the map has its
// metres counted from its lower left corner, y up. The first point comes to lie where it is on the map, and
// all lengths of the picture are right then; it is turned if it is known where the second is as well.

/** @typedef {{ x: number, y: number }} At */
/** @typedef {{ x: number, y: number, width: number, height: number, turn: number }} Placement */

/**
 * Make a picture larger or smaller around one of its points, until two of its points are so many metres apart.
 * @param {Placement} placement as it lies now
 * @param {At} first in metres, as it is seen now; it stays where it is
 * @param {At} second
 * @param {number} metres
 * @returns {Placement}
 */
export function calibrated({ x, y, width, height, turn }, first, second, metres) {
  const scale = metres / Math.hypot(second.x - first.x, second.y - first.y);
  return {
    x: first.x - (first.x - x) * scale, y: first.y - (first.y - y) * scale,
    width: width * scale, height: height * scale, turn,
  };
}
