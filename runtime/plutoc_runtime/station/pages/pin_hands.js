// Moving a pin: by a pointer, snapping to 0.1 m (0.01 m with Shift), or by the arrow keys, 0.1 m a
// press (1 m with Shift). Esc puts a dragged pin back; Delete removes one; Enter goes to its card.

import { round } from "./floor_view.js";

const STILL = 4; // pixels: less is a click, not a drag
const ARROWS = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
};

/** The place under a pointer, as it is written down. */
export function snapped(floor, event, dx = 0, dy = 0) {
  const { x, y } = floor.toMetres({ clientX: event.clientX - dx, clientY: event.clientY - dy });
  const step = event.shiftKey ? 0.01 : 0.1;
  return [round(x, step), round(y, step)];
}

export function draggable(floor, pin, { locked, drag, place, remove, open }) {
  let held = null; // where it was taken, and how far from its middle

  pin.addEventListener("pointerdown", (event) => {
    if (event.button > 0 || held) return;
    pin.focus();
    event.preventDefault();
    if (locked()) return;
    const at = floor.toPixels(pin.trip.target[0], pin.trip.target[1]);
    const box = floor.picture.getBoundingClientRect();
    held = {
      id: event.pointerId, x: event.clientX, y: event.clientY, target: null,
      dx: event.clientX - box.left - at.x - pin.beside, dy: event.clientY - box.top - at.y,
    };
    pin.setPointerCapture(event.pointerId);
  });

  pin.addEventListener("pointermove", (event) => {
    if (held?.id !== event.pointerId) return;
    const far = Math.hypot(event.clientX - held.x, event.clientY - held.y);
    if (!held.target && far < STILL) return;
    held.target = snapped(floor, event, held.dx, held.dy);
    drag(held.target);
  });

  const end = (event) => {
    if (!held || (event.pointerId ?? held.id) !== held.id) return;
    const { target } = held;
    held = null;
    if (!target) return;
    if (event.type === "pointerup") place(target);
    else drag(null);
  };
  for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) {
    pin.addEventListener(kind, end);
  }

  pin.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape" && held) end(event);
    else if (event.key === "Enter" || event.key === " ") open();
    else if (locked()) return;
    else if (event.key in ARROWS) {
      const step = event.shiftKey ? 1 : 0.1;
      const [dx, dy] = ARROWS[event.key];
      const [x, y] = pin.trip.target;
      place([round(x + dx * step, 0.01), round(y + dy * step, 0.01)]);
    } else if (event.key === "Delete" || event.key === "Backspace") remove();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
}
