// The trips of a mission as a list of cards, in the order in which they are flown. One of them is
// open: the chosen one. Dragged by their grips, or moved with Alt and the arrow keys.
//
//   const cards = tripCards(app, { choose, move, remove, copy, set, parameter, item, action });
//   cards.element   cards.update({ trips: [see tripBody.update, and words, trouble], chosen, locked })

import { actionSign } from "./action_signs.js";
import { fill, h, keyed, put, set, shown, unique } from "./dom.js";
import { icon } from "./dom.js";
import { number } from "./numbers.js";
import { reorderable } from "./dom.js";
import { tripBody } from "./trip_body.js";

export function tripCards(app, act) {
  const element = h("ol", { class: "trip-cards", "aria-label": "Trips, in their order" });
  const parts = new WeakMap();
  let shownTrips = [];
  let locked = false;
  let opened = null; // the card that was chosen at the last update

  reorderable(element, (from, to) => !locked && act.move(shownTrips[from].key, to));

  function make({ key }) {
    const id = unique("trip");
    const badge = h("span", { class: "number num", "aria-hidden": "true" });
    const sign = h("span", { class: "what-sign" });
    const words = h("strong", {});
    const where = h("span", { class: "hint num" });
    const trouble = h("span", { class: "trip-sign" });
    const head = h("button", {
      type: "button", class: "trip-head", "aria-controls": id,
      onclick: () => act.choose(head.getAttribute("aria-expanded") === "true" ? null : key),
      onkeydown(event) {
        if (event.key !== "Delete" || locked) return;
        event.preventDefault();
        act.remove(key);
      },
    }, badge, sign, h("span", { class: "what" }, words, where), trouble);
    const grip = h("span", { class: "grip", "aria-hidden": "true" }, icon("grip"));
    const body = h("div", { id });
    const card = h("li", {
      class: "trip-card", "data-key": key,
      onkeydown(event) {
        const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
        if (!event.altKey || !step || locked) return;
        event.preventDefault();
        shift(key, step);
      },
    }, h("div", { class: "trip-line" }, grip, head), body);
    parts.set(card, { badge, sign, words, where, trouble, head, grip, body, action: null, fields: null });
    return card;
  }

  function shift(key, by) {
    act.move(key, shownTrips.findIndex((trip) => trip.key === key) + by);
  }

  function show(card, about, at, isOpen) {
    const part = parts.get(card);
    const { trip } = about;
    put(part.badge, about.number);
    put(part.words, about.words);
    put(part.where, trip.target ? `${trip.target.map(number).join(", ")} m` : "no place yet");
    if (part.action !== trip.action) {
      part.action = trip.action;
      part.fields = null;
      fill(part.sign, actionSign(trip.action));
    }
    const wrong = about.trouble ? "To mend" : "";
    if (part.trouble.textContent !== wrong) {
      fill(part.trouble, wrong && h("span", { class: "chip warn" }, icon("warning"), wrong));
    }
    set(part.head, "aria-expanded", String(isOpen));
    card.classList.toggle("chosen", isOpen);
    shown(part.grip, !locked);
    shown(part.body, isOpen);
    if (!isOpen) {
      if (part.fields) fill(part.body);
      part.fields = null;
      return;
    }
    part.fields ??= bodyOf(trip, part.body);
    part.fields.update({ ...about, locked, first: at === 0, last: at === shownTrips.length - 1 });
  }

  function bodyOf({ key, action }, place) {
    const known = app.actions.find(({ name }) => name === action);
    const fields = tripBody(app, known ?? { name: action, parameters: [], item: false }, {
      set: (name, value, typing) => act.set(key, name, value, typing),
      parameter: (name, value, typing) => act.parameter(key, name, value, typing),
      item: (name, value, typing) => act.item(key, name, value, typing),
      action: (name) => act.action(key, name),
      move: (by) => shift(key, by),
      copy: () => act.copy(key),
      remove: () => act.remove(key),
    });
    fill(place, fields.element);
    return fields;
  }

  return {
    element,
    update({ trips, chosen, locked: now }) {
      shownTrips = trips;
      locked = now;
      keyed(element, trips, (about) => about.key, make, (card, about, at) =>
        show(card, about, at, about.key === chosen));
      if (chosen !== opened) {
        opened = chosen;
        const card = cardOf(chosen);
        if (card) requestAnimationFrame(() => seen(card));
      }
    },
    focus: (key) => cardOf(key)?.querySelector(".trip-head").focus(),
    fillIn: (key) => cardOf(key)?.querySelector(".trip-body select, .trip-body input")?.focus(),
  };

  /** Scrolls the list, but never the page: the map stays where it is. */
  function seen(card) {
    const [box, all] = [card.getBoundingClientRect(), element.getBoundingClientRect()];
    const below = Math.min(box.bottom - all.bottom + 6, box.top - all.top - 4);
    if (below > 0) element.scrollTop += below;
    else if (box.top < all.top) element.scrollTop += box.top - all.top - 4;
  }

  function cardOf(key) {
    return [...element.children].find((card) => card.dataset.key === key);
  }
}
