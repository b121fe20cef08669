// The pins of a mission's trips on the floor plan, numbered and joined in their order. They are
// dragged in steps of 0.1 m (0.01 m with Shift), or moved with the arrow keys.

import { keyed, put, set, svg } from "./dom.js";

const BESIDE = 25; // pixels between pins at one place
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const round = (value, step) => Number((Math.round(value / step) * step).toFixed(2));

export const metres = (target) => target.map((one) => Number(one.toFixed(3))).join(", ");

// The place under a pointer, as it is written down.
export function snapped(floor, { clientX, clientY, shiftKey }, dx = 0, dy = 0) {
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
    const pin = svg("g", { class: "pin", role: "button", tabindex: 0, "data-own": "", "data-key": key },
      svg("circle", { class: "reach", r: 20 }), svg("circle", { class: "halo", r: 18 }),
      svg("circle", { class: "disc", r: 12.5 }), svg("text", { y: 4.5 }),
      svg("path", { class: "pin-sign", d: "M11 -20L19 -5H3ZM11 -15v5M11 -8v.5" }),
      svg("g", { class: "pin-words" }, svg("rect", { rx: 9, height: 20, y: 20 }), svg("text", { y: 34 })));
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
      put(pin.children[3], trip.number);
      const [plate, words] = pin.lastChild.children;
      put(words, trip.words);
      const width = trip.words.length * 7.2 + 14; // more or less
      set(plate, "width", width);
      set(plate, "x", -width / 2);
    });
    const points = placed.filter(({ key }) => key !== "new").map(({ target: [x, y] }) => `${x},${y}`);
    set(way, "points", points.join(" "));
    set(start, "points", points.length && home && `${home[0]},${home[1]} ${points[0]}`);
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
      x: event.clientX, y: event.clientY,
      dx: event.clientX - at.left - at.width / 2, dy: event.clientY - at.top - at.height / 2,
    };
    pin.setPointerCapture(event.pointerId);
  };
  pin.onpointermove = (event) => {
    if (!drag || (!drag.target && Math.hypot(event.clientX - drag.x, event.clientY - drag.y) < 4)) return;
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
