// A pointer from its press to its release.

import { pan, viewport } from "./camera.js";

const STILL = 4; // pixels within which a drag is a click yet
const NEAR = 28; // pixels from the rim within which the view moves along
const PACE = 9; // pixels a frame

// Calls moved(event) at most once a frame while the pointer is down, then up(event, wasMoved).
export function follow(start, moved, up, { rim = false } = {}) {
  const { pointerId, clientX, clientY } = start;
  let [latest, far, frame] = [null, false, 0];
  viewport.setPointerCapture(pointerId);
  const step = () => {
    frame = 0;
    if (!latest) return;
    const [dx, dy] = rim ? beyond(latest) : [0, 0];
    if (dx || dy) {
      pan(dx, dy);
      frame = requestAnimationFrame(step);
    }
    moved(latest);
  };
  const move = (event) => {
    far ||= Math.hypot(event.clientX - clientX, event.clientY - clientY) >= STILL;
    if (!far) return;
    latest = event;
    frame ||= requestAnimationFrame(step);
  };
  const end = (event) => {
    cancelAnimationFrame(frame);
    if (far && event.type === "pointerup") moved(event);
    for (const [name, ear] of ears) viewport.removeEventListener(name, ear);
    document.removeEventListener("keydown", escape, true);
    up(event, far && event.type === "pointerup");
  };
  const escape = (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    end(event);
  };
  const ears = [["pointermove", move], ["pointerup", end], ["pointercancel", end]];
  for (const [name, ear] of ears) viewport.addEventListener(name, ear);
  document.addEventListener("keydown", escape, true);
}

function beyond({ clientX, clientY }) {
  const { left, right, top, bottom } = viewport.getBoundingClientRect();
  const by = (at, low, high) => (at < low + NEAR ? PACE : at > high - NEAR ? -PACE : 0);
  return [by(clientX, left, right), by(clientY, top, bottom)];
}
