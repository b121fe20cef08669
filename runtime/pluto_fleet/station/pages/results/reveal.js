// Showing a place on the map where no card covers it: the card of a result lies at the left, on a phone
// below the map.

import { toPixels } from "../map/view.js";

/** @import { Camera } from "../map/camera.js" */

const CARD = 340; // pixels of its width
const NARROW = 520; // pixels of a map that is above its card
const EDGE = 40;

/** @param {Camera} camera @param {number} x @param {number} y metres @param {number} [closest] the scale to show it at, if it is not shown larger */
export function revealBeside(camera, x, y, closest = 0) {
  const { width, height } = camera.box.peek();
  if (!width) return;
  const view = camera.view.peek();
  const left = width < NARROW ? EDGE : CARD + EDGE;
  const at = toPixels(view, x, y);
  const isSeen = at.x > left && at.x < width - EDGE && at.y > EDGE && at.y < height - EDGE;
  const scale = Math.max(view.scale, closest);
  if (isSeen && scale === view.scale) return;
  const middle = { x: (left + width - EDGE) / 2, y: height / 2 };
  camera.look({ scale, left: middle.x - x * scale, bottom: middle.y + y * scale });
}
