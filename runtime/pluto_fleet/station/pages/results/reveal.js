// Showing a place on the map where no card covers it: the card of a result lies at the lower left, on a
// narrow map over all of its foot.

import { toPixels } from "../map/view.js";

/** @import { Camera } from "../map/camera.js" */

const CARD = 340; // pixels of its width
const NARROW = 520; // pixels of a map beside whose card there is no room
const EDGE = 40;

/** @param {Camera} camera @param {number} x @param {number} y metres @param {number} [closest] the scale to show it at, if it is not shown larger */
export function revealBeside(camera, x, y, closest = 0) {
  const { width, height } = camera.box.peek();
  if (!width) return;
  const view = camera.view.peek();
  const isNarrow = width < NARROW;
  const free = isNarrow ? { left: EDGE, bottom: height * 0.35 } : { left: CARD + EDGE, bottom: height - EDGE };
  const at = toPixels(view, x, y);
  const isSeen = at.x > free.left && at.x < width - EDGE && at.y > EDGE && at.y < free.bottom;
  const scale = Math.max(view.scale, closest);
  if (isSeen && scale === view.scale) return;
  const middle = { x: (free.left + width - EDGE) / 2, y: (EDGE + free.bottom) / 2 };
  camera.look({ scale, left: middle.x - x * scale, bottom: middle.y + y * scale });
}
