// Putting trips on the floor plan. Actions are dragged there, or taken in hand by pressing one and
// put down by pressing a place or writing x and y. Pins, joined in their order, are dragged in
// steps of 0.1 m (0.01 m with Shift), or moved with the arrow keys.

import { button, fill, h, icon, keyed, plain, put, set, svg } from "./dom.js";

const BESIDE = 25; // pixels between pins at one place
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const apart = (one, other) =>
  Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
const round = (value, step) => Number((Math.round(value / step) * step).toFixed(2));

export const metres = (target) => target.map((one) => Number(one.toFixed(3))).join(", ");

// The place under a pointer, as it is written down.
function snapped(floor, { clientX, clientY, shiftKey }, dx = 0, dy = 0) {
  const { x, y } = floor.toMetres({ clientX: clientX - dx, clientY: clientY - dy });
  return [x, y].map((one) => round(one, shiftKey ? 0.01 : 0.1));
}

// act: { choose(key), drag(key, target | null), place(key, target), remove(key), open(key) }
export function pins(floor, act) {
  const [faint, lines, layer] = ["other-trips", "path", "pins"].map(floor.layer);
  const start = svg("polyline", { class: "from-home" });
  const way = svg("polyline");
  lines.append(start, way);
  let isLocked = false;
  let others = "";

  function make({ key }) {
    const pin = svg("g", { role: "button", tabindex: 0, "data-own": "", "data-key": key },
      svg("circle", { class: "halo", r: 20 }), svg("circle", { class: "disc", r: 12.5 }),
      svg("text", { y: 4.5 }),
      svg("path", { class: "pin-sign", d: "M11 -20L19 -5H3ZM11 -15v5M11 -8v.5" }),
      svg("g", { class: "pin-words" },
        svg("rect", { rx: 9, height: 20, y: 20 }), svg("text", { y: 34 })));
    pin.onfocus = () => act.choose(key);
    held(floor, pin, key, act, () => isLocked);
    return floor.mark(0, 0, pin);
  }

  // trips: [{ key, number, target, words, trouble }…]
  function update({ trips, chosen, locked, home }) {
    isLocked = locked;
    const placed = trips.filter(({ target }) => target);
    const taken = new Map();
    keyed(layer, placed, ({ key }) => key, make, (mark, trip) => {
      const pin = mark.firstChild.firstChild;
      const [x, y] = trip.target;
      const at = `${x.toFixed(1)} ${y.toFixed(1)}`;
      const before = taken.get(at) ?? 0;
      taken.set(at, before + 1);
      pin.trip = trip;
      pin.beside = before * BESIDE;
      floor.move(mark, x, y);
      set(pin, "transform", `translate(${pin.beside} 0)`);
      set(pin, "class", ["pin", trip.key === chosen && "chosen", trip.trouble && "bad",
        trip.key === "new" && "new"].filter(Boolean).join(" "));
      set(pin, "aria-label", `Trip ${trip.number}: ${trip.words}, at ${metres([x, y])} metres.`
        + (trip.trouble && ` Problem: ${trip.trouble}`)
        + (locked ? "" : " Arrow keys move it, Delete removes it, Enter opens its card."));
      put(pin.children[2], trip.number);
      const [plate, words] = pin.lastChild.children;
      put(words, trip.words.length > 28 ? `${trip.words.slice(0, 27)}…` : trip.words);
      const width = words.textContent.length * 7.2 + 14; // more or less
      set(plate, "width", width);
      set(plate, "x", -width / 2);
    });
    const kept = placed.filter(({ key }) => key !== "new");
    const points = kept.map(({ target }) => target.slice(0, 2));
    set(way, "points", points.join(" "));
    set(start, "points", points.length && home && `${home.slice(0, 2)} ${points[0]}`);
  }

  // Those of other missions, faintly: [[words, [x, y]]…]
  function showOthers(places) {
    if (JSON.stringify(places) === others) return;
    others = JSON.stringify(places);
    faint.replaceChildren(...places.map(([words, [x, y]]) =>
      floor.mark(x, y, svg("circle", { r: 5 }, svg("title", {}, words)))));
  }
  return { update, showOthers };
}

function held(floor, pin, key, act, isLocked) {
  let drag = null; // where it was taken, and how far from its middle
  const end = (event) => {
    if (!drag) return;
    const { target } = drag;
    drag = null;
    if (target && event.type === "pointerup") act.place(key, target);
    else if (target) act.drag(key, null);
  };
  pin.onpointerdown = (event) => {
    if (event.button) return;
    event.preventDefault();
    pin.focus();
    if (isLocked()) return;
    const at = pin.querySelector(".disc").getBoundingClientRect();
    drag = {
      event, dx: event.clientX - at.left - at.width / 2, dy: event.clientY - at.top - at.height / 2,
    };
    pin.setPointerCapture(event.pointerId);
  };
  pin.onpointermove = (event) => {
    if (!drag || (!drag.target && apart(event, drag.event) < 4)) return;
    drag.target = snapped(floor, event, drag.dx, drag.dy);
    act.drag(key, drag.target);
  };
  for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) {
    pin.addEventListener(kind, end);
  }
  pin.onkeydown = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape" && drag) end(event);
    else if (event.key === "Enter" || event.key === " ") act.open(key);
    else if (isLocked()) return;
    else if (event.key in ARROWS) {
      const by = ARROWS[event.key].map((one) => one * (event.shiftKey ? 1 : 0.1));
      const target = by.map((one, axis) => round(pin.trip.target[axis] + one, 0.01));
      pin.trip = { ...pin.trip, target }; // the next press may come before it is drawn anew
      act.place(key, target);
    } else if (event.key === "Delete") act.remove(key);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}

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
  set(button("Cancel", () => back(), "quiet"), "type", "button"));
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
    fill(said, inHand
      ? [h("strong", {}, called(inHand.name)), ": press a place on the map, or write"]
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
    if (apart(event, pressed) > 6) return;
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
      if (apart(event, from) < 8) return;
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
