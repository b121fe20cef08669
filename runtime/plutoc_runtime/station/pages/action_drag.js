// Dragging an action onto the floor plan: the browser's own drag and drop with a mouse, and the same
// by hand for a finger or a pen, for which browsers have none.

import { snapped } from "./pin_hands.js";

const KIND = "application/x-pluto-action";

export function dragOnto(floor, chip, act) {
  let dragging = false; // only what was taken here may be dropped
  const { picture } = floor;

  chip.addEventListener("dragstart", (event) => {
    if (act.locked()) {
      event.preventDefault();
      return;
    }
    dragging = true;
    event.dataTransfer.setData(KIND, chip.dataset.action);
    event.dataTransfer.setData("text/plain", chip.textContent);
    event.dataTransfer.effectAllowed = "copy";
    act.begin();
  });
  chip.addEventListener("dragend", () => {
    dragging = false;
    act.hover(null);
  });
  picture.addEventListener("dragover", (event) => {
    if (!dragging) return;
    event.preventDefault();
    event.dataTransfer.dropEffect = "copy";
    act.hover(snapped(floor, event));
  });
  picture.addEventListener("dragleave", (event) => {
    if (dragging && !picture.contains(event.relatedTarget)) act.hover(null);
  });
  picture.addEventListener("drop", (event) => {
    if (!dragging) return;
    event.preventDefault();
    act.drop(snapped(floor, event));
  });
  byFinger(floor, chip, act);
}

function byFinger(floor, chip, act) {
  let held = null;
  let ghost = null;

  chip.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse" || act.locked()) return;
    chip.setAttribute("draggable", "false"); // else a long press would begin the browser's own
    held = { id: event.pointerId, x: event.clientX, y: event.clientY };
    chip.setPointerCapture(event.pointerId);
  });

  chip.addEventListener("pointermove", (event) => {
    if (held?.id !== event.pointerId) return;
    if (!ghost) {
      if (Math.hypot(event.clientX - held.x, event.clientY - held.y) < 8) return;
      act.begin();
      ghost = chip.cloneNode(true);
      ghost.className = "action ghost";
      ghost.removeAttribute("tabindex");
      document.body.append(ghost);
    }
    ghost.style.transform = `translate(${event.clientX + 12}px, ${event.clientY - 56}px)`;
    act.hover(over(floor, event) ? snapped(floor, event) : null);
  });

  const end = (event) => {
    if (held?.id !== event.pointerId) return;
    held = null;
    chip.setAttribute("draggable", String(!act.locked()));
    if (!ghost) return;
    ghost.remove();
    ghost = null;
    act.hover(null);
    if (event.type === "pointerup" && over(floor, event)) act.drop(snapped(floor, event));
    // The press that follows a drag is not a press on the action.
    chip.addEventListener("click", (click) => click.stopImmediatePropagation(), {
      capture: true, once: true, signal: AbortSignal.timeout(300),
    });
  };
  chip.addEventListener("pointerup", end);
  chip.addEventListener("pointercancel", end);
}

function over(floor, event) {
  const box = floor.picture.getBoundingClientRect();
  return event.clientX >= box.left && event.clientX <= box.right
    && event.clientY >= box.top && event.clientY <= box.bottom;
}
