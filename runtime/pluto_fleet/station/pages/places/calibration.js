// Where a floor plan lies, by two of its points and the length between them: the same formula as the
// station's (station/map/calibration.py). Pure.

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
