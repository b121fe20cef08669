// The actions that can be put on the floor plan: dragged there, or taken in hand by pressing one and
// put down by pressing a place on the map or by writing x and y.
//
//   const list = actions(app, floor, { add(action, [x, y]), hover(action, [x, y] | null) });
//   list.element      list.lock(true) where nothing may be added

import { dragOnto } from "./action_drag.js";
import { actionSign, called } from "./action_signs.js";
import { fill, h, set, unique } from "./dom.js";
import { snapped } from "./pin_hands.js";
import { read } from "./numbers.js";

export function actions(app, floor, act) {
  const chips = new Map();
  let inHand = null;
  let locked = false;

  for (const action of app.actions) {
    // Not a <button>: those cannot be dragged in every browser.
    const chip = h("div", {
      class: "action", role: "button", tabindex: 0, draggable: "true", "data-action": action.name,
      "aria-pressed": "false",
    }, actionSign(action.name), called(action.name));
    chip.addEventListener("click", () => take(inHand === action ? null : action));
    chip.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      take(action);
      if (inHand) where.x.focus();
    });
    dragOnto(floor, chip, {
      locked: () => locked,
      begin: () => take(null),
      hover: (target) => act.hover(action, target),
      drop: (target) => act.add(action, target),
    });
    chips.set(action, chip);
  }

  const said = h("p", { class: "in-hand-said" });
  const where = placeForm((target) => {
    act.add(inHand, target);
    back();
  }, () => back());
  const line = h("div", { class: "in-hand" }, said, where.element);
  const element = h("section", { class: "actions card", "aria-label": "Actions" },
    h("div", { class: "action-list", role: "group", "aria-label": "Actions to put on the map" },
      ...chips.values()), line);

  function take(action) {
    inHand = locked ? null : action;
    for (const [other, chip] of chips) set(chip, "aria-pressed", String(other === inHand));
    floor.element.classList.toggle("aiming", inHand !== null);
    where.element.hidden = inHand === null;
    if (inHand) fill(said, h("strong", {}, called(inHand.name)), ": press a place on the map, or write");
    else {
      fill(said, "Drag an action onto the map. Or press it, then press where on the map.");
      act.hover(null, null);
    }
  }

  /** Put it back, and go back to where it lies: the form that had the focus is gone. */
  function back() {
    const chip = chips.get(inHand);
    take(null);
    chip.focus();
  }

  aim(floor, () => inHand, {
    hover: (target) => act.hover(inHand, target),
    drop(target) {
      act.add(inHand, target);
      take(null);
    },
    away: () => take(null),
  });
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && inHand) back();
  });
  take(null);
  return {
    element,
    lock(now) {
      if (now === locked) return;
      locked = now;
      for (const chip of chips.values()) set(chip, "draggable", String(!locked));
      take(null);
    },
  };
}

/** With an action in hand, a press on the map (not a drag, which moves it) puts it down. */
function aim(floor, inHand, act) {
  let pressed = null;
  const { picture } = floor;
  picture.addEventListener("pointerdown", (event) => {
    pressed = event.isPrimary ? { x: event.clientX, y: event.clientY } : null;
  });
  picture.addEventListener("pointermove", (event) => {
    if (inHand() && event.pointerType === "mouse") act.hover(snapped(floor, event));
  });
  picture.addEventListener("pointerup", (event) => {
    if (!inHand() || !pressed) return;
    if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < 6) {
      act.drop(snapped(floor, event));
    }
    pressed = null;
  });
  picture.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && inHand()) act.away();
  });
}

function placeForm(add, cancel) {
  const coordinate = (name) => {
    const id = unique("at");
    const input = h("input", { id, class: "input coordinate", inputmode: "decimal", autocomplete: "off" });
    return { input, parts: [h("label", { for: id }, name), input] };
  };
  const [x, y] = [coordinate("x"), coordinate("y")];
  const element = h("form", { class: "place-form", hidden: true }, ...x.parts, ...y.parts, "m",
    h("button", { class: "button primary", type: "submit" }, "Add"),
    h("button", { class: "button quiet", type: "button", onclick: cancel }, "Cancel"));
  element.addEventListener("submit", (event) => {
    event.preventDefault();
    const target = [x.input, y.input].map((input) => {
      const value = read(input.value);
      set(input, "aria-invalid", value === null ? "true" : null);
      return value;
    });
    const wrong = target.indexOf(null);
    if (wrong >= 0) [x.input, y.input][wrong].focus();
    else {
      add(target);
      x.input.value = y.input.value = "";
    }
  });
  return { element, x: x.input };
}
