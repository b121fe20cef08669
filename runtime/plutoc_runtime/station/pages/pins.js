// The pins of a mission's trips on the floor plan, numbered and joined in their order. They can be
// dragged, moved with the arrow keys and deleted; a pin that may not be where it is says so.
//
//   const shown = pins(floor, { choose(key), drag(key, [x, y]), place(key, [x, y]),
//                             remove(key), open(key) });
//   shown.update({ trips: [{ key, number, target, words, place, trouble }…], chosen, locked, home });
//   shown.others([[words, [x, y]]…]);      the places of other missions, faintly

import { keyed, put, set, svg } from "./dom.js";
import { draggable } from "./pin_hands.js";
import { name, pinWords } from "./pin_words.js";
import { number } from "./numbers.js";

const BESIDE = 25; // pixels between pins at one and the same place

export function pins(floor, act) {
  const faint = floor.layer("other-trips");
  const lines = floor.layer("path");
  const layer = floor.layer("pins");
  const start = svg("polyline", { class: "from-home" });
  const way = svg("polyline", { class: "way" });
  lines.append(start, way);
  let locked = false;
  let others = "";

  function make({ key }) {
    const pin = svg("g", { class: "pin", role: "button", tabindex: 0, "data-own": "", "data-key": key },
      svg("circle", { class: "reach", r: 20 }),
      svg("circle", { class: "halo", r: 18 }),
      svg("circle", { class: "disc", r: 12.5 }),
      svg("text", { class: "pin-number", y: 4.5 }),
      svg("g", { class: "pin-sign", transform: "translate(11 -12)" },
        svg("path", { d: "M0 -8 L8.5 7 H-8.5 Z" }), svg("text", { y: 5 }, "!")),
      pinWords());
    pin.addEventListener("focus", () => act.choose(key));
    draggable(floor, pin, {
      locked: () => locked,
      drag: (target) => act.drag(key, target),
      place: (target) => act.place(key, target),
      remove: () => act.remove(key),
      open: () => act.open(key),
    });
    return floor.mark(0, 0, pin);
  }

  function update({ trips, chosen, locked: now, home }) {
    locked = now;
    const placed = trips.filter((trip) => trip.target);
    const beside = offsets(placed);
    keyed(layer, placed, (trip) => trip.key, make, (mark, trip) => {
      const pin = mark.firstElementChild.firstElementChild;
      const [x, y] = trip.target;
      floor.move(mark, x, y);
      pin.trip = trip;
      pin.beside = beside.get(trip.key);
      set(pin, "transform", pin.beside ? `translate(${pin.beside} 0)` : null);
      set(pin, "class", `pin${trip.key === chosen ? " chosen" : ""}${trip.trouble ? " bad" : ""}`);
      set(pin, "aria-label", described(trip, locked));
      put(pin.querySelector(".pin-number"), trip.number);
      const words = trip.dragged ? `${number(x)}, ${number(y)} m` : trip.words;
      name(pin.lastChild, trip.place || words, { floor, target: trip.target });
    });
    const points = placed.map(({ target: [x, y] }) => `${x},${y}`);
    set(way, "points", points.join(" "));
    set(start, "points", points.length && home ? `${home[0]},${home[1]} ${points[0]}` : null);
  }

  return {
    update,
    others(places) {
      const now = JSON.stringify(places);
      if (now === others) return;
      others = now;
      faint.replaceChildren(...places.map(([words, [x, y]]) =>
        floor.mark(x, y, svg("circle", { r: 5 }, svg("title", {}, words)))));
    },
    focus(key) {
      layer.querySelector(`[data-key="${key}"]`)?.focus();
    },
  };
}

/** Pins at one place stand beside each other: how many pixels each is to the right of it. */
function offsets(trips) {
  const count = new Map();
  return new Map(trips.map(({ key, target: [x, y] }) => {
    const place = `${x.toFixed(1)} ${y.toFixed(1)}`;
    const before = count.get(place) ?? 0;
    count.set(place, before + 1);
    return [key, before * BESIDE];
  }));
}

function described(trip, locked) {
  const [x, y] = trip.target;
  const how = locked ? "" : " Arrow keys move it, Delete removes it, Enter opens its card.";
  const trouble = trip.trouble ? ` Problem: ${trip.trouble}` : "";
  return `Trip ${trip.number}: ${trip.words}, at ${number(x)}, ${number(y)} metres.${trouble}${how}`;
}
