// The actions that can be put on the floor plan: dragged there, or taken in hand by pressing one and
// put down by pressing a place on the map or by writing x and y.

import { fill, h, icon, plain, set } from "./dom.js";
import { snapped } from "./pins.js";

const SIGNS = {
  take_photo: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
  measure: "M10 4.5a2 2 0 014 0v9.2a4 4 0 11-4 0zM12 9v7.5",
  pick_item: "M5 15v5h14v-5M12 15V4M7 9l5-5 5 5",
  release_item: "M5 15v5h14v-5M12 4v11M7 10l5 5 5-5",
};
const STAR = "M12 4l2.3 5.2 5.7.6-4.2 3.9 1.2 5.6-5-2.9-5 2.9 1.2-5.6L4 9.8l5.7-.6z";

// "take_photo" is "Take photo".
export const called = (name) => plain(name).replace(/^./, (first) => first.toUpperCase());
export const actionSign = (name) => icon(SIGNS[name] ?? STAR);

// act: { add(action, target), hover(action, target | null) }
export function actions(app, floor, act) {
  const { picture } = floor;
  let inHand = null;
  let pressed = null; // where a press on the map began: a drag moves the map

  const chips = app.actions.map((action) => {
    // Not a <button>: those cannot be dragged in every browser.
    const chip = h("div", {
      class: "action button", role: "button", tabindex: 0, draggable: "true",
      "data-action": action.name, onclick: () => take(inHand === action ? null : action),
      onkeydown(event) {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        take(action);
        x.focus();
      },
    }, actionSign(action.name), called(action.name));
    byMouse(floor, chip, action, act, () => take(null));
    byFinger(floor, chip, action, act, () => take(null));
    return chip;
  });
  const said = h("p", { class: "hint" });
  const [x, y] = ["x", "y"].map((axis) =>
    h("input", {
      class: "input", inputmode: "decimal", required: true, pattern: "-?\\d+([.,]\\d+)?",
      title: "metres, such as 2.5", "aria-label": axis,
    }));
  const form = h("form", {
    class: "row",
    onsubmit(event) {
      event.preventDefault();
      act.add(inHand, [x, y].map(({ value }) => Number(value.replace(",", "."))));
      form.reset();
      back();
    },
  }, "x", x, "y", y, "m", h("button", { class: "button primary" }, "Add"),
  h("button", { class: "button quiet", type: "button", onclick: back }, "Cancel"));
  const element = h("section", {
    class: "card actions", "aria-label": "Actions",
    onkeydown: ({ key }) => key === "Escape" && inHand && back(),
  }, h("div", { class: "row", role: "group", "aria-label": "Actions to put on the map" }, chips),
  h("div", { class: "in-hand row" }, said, form));

  function take(action) {
    inHand = action;
    chips.forEach((chip, at) => set(chip, "aria-pressed", String(app.actions[at] === inHand)));
    picture.classList.toggle("aiming", inHand);
    form.hidden = !inHand;
    fill(said, inHand ? [h("strong", {}, called(inHand.name)), ": press a place on the map, or write"]
      : "Drag an action onto the map. Or press it, then press where on the map.");
    if (!inHand) act.hover(null, null);
  }

  // Puts it back, and the focus with it, as the form that had it is gone.
  function back() {
    const chip = chips[app.actions.indexOf(inHand)];
    take(null);
    chip.focus();
  }

  picture.addEventListener("pointerdown", (event) => { pressed = event.isPrimary && event; });
  picture.addEventListener("pointermove", (event) => {
    if (inHand && event.pointerType === "mouse") act.hover(inHand, snapped(floor, event));
  });
  picture.addEventListener("pointerup", (event) => {
    if (!inHand || !pressed) return;
    if (Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 6) return;
    act.add(inHand, snapped(floor, event));
    take(null);
  });
  picture.addEventListener("keydown", ({ key }) => key === "Escape" && inHand && back());
  take(null);
  return { element, putBack: () => take(null) };
}

// The browser's own drag and drop.
function byMouse(floor, chip, action, act, begin) {
  const { picture } = floor;
  let dragging = false; // only what was taken here may be dropped
  const over = (kind, heard) => picture.addEventListener(kind, (event) => {
    if (!dragging) return;
    event.preventDefault();
    heard(snapped(floor, event), event);
  });
  chip.addEventListener("dragstart", ({ dataTransfer }) => {
    dragging = true;
    dataTransfer.setData("text/plain", chip.textContent);
    dataTransfer.effectAllowed = "copy";
    begin();
  });
  chip.addEventListener("dragend", () => {
    dragging = false;
    act.hover(action, null);
  });
  over("dragover", (target) => act.hover(action, target));
  over("dragleave", (_, event) => picture.contains(event.relatedTarget) || act.hover(action, null));
  over("drop", (target) => act.add(action, target));
}

// The same for fingers and pens, for which browsers have no drag and drop.
function byFinger(floor, chip, action, act, begin) {
  let from = null;
  let ghost = null;
  const target = (event) => {
    const box = floor.picture.getBoundingClientRect();
    return event.clientX > box.left && event.clientX < box.right && event.clientY > box.top
      && event.clientY < box.bottom ? snapped(floor, event) : null;
  };
  chip.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse") return;
    chip.draggable = false; // else a long press begins the browser's own
    from = event;
    chip.setPointerCapture(event.pointerId);
  });
  chip.addEventListener("pointermove", (event) => {
    if (!from) return;
    if (!ghost) {
      if (Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) < 8) return;
      begin();
      ghost = chip.cloneNode(true);
      ghost.classList.add("ghost");
      document.body.append(ghost);
    }
    ghost.style.transform = `translate(${event.clientX + 12}px, ${event.clientY - 56}px)`;
    act.hover(action, target(event));
  });
  const end = (event) => {
    const wasDragged = ghost;
    ghost?.remove();
    chip.setAttribute("draggable", "true");
    from = ghost = null;
    if (!wasDragged) return;
    act.hover(action, null);
    if (event.type === "pointerup" && target(event)) act.add(action, target(event));
  };
  chip.addEventListener("pointerup", end);
  chip.addEventListener("pointercancel", end);
}
