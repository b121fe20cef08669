// The trips of a mission as cards, in the order in which they are flown. The chosen one is open.

import { actionSign } from "./actions.js";
import { fieldFor, fill, h, icon, keyed, put, reorderable, set, shown, unique } from "./dom.js";
import { metres } from "./pins.js";
import { RELEASE } from "./trip_acts.js";

const MASS = { name: "mass", type: "mass", units: ["g", "mg", "kg"] };

export const problemLine = (text) => h("p", { class: "problem" }, icon("warning"), h("span", {}, text));

export function tripCards(app, act) {
  const element = h("ol", { class: "trip-cards", "aria-label": "Trips, in their order" });
  const parts = new WeakMap();
  let shownTrips = [];
  let isLocked = false;
  let opened = null;

  reorderable(element, (from, to) => !isLocked && act.move(shownTrips[from].key, to));
  const shift = (key, by) => act.move(key, shownTrips.findIndex((trip) => trip.key === key) + by);

  function make({ key, trip }) {
    const id = unique("trip");
    const [number, words, where, sign] = ["number", "words", "hint", "sign"].map((name) =>
      h("span", { class: name }));
    const head = h("button", {
      class: "trip-head", "aria-controls": id, onclick: () => act.choose(key === opened ? null : key),
      onkeydown: (event) => event.key === "Delete" && !isLocked && act.remove(key),
    }, number, actionSign(trip.action), h("span", { class: "what" }, words, " ", where), sign);
    const body = h("div", { id });
    const card = h("li", {
      class: "trip-card", "data-key": key,
      onkeydown(event) {
        const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
        if (!event.altKey || !by || isLocked) return;
        event.preventDefault();
        shift(key, by);
      },
    }, h("div", { class: "trip-line" }, h("span", { class: "grip" }, icon("grip")), head), body);
    parts.set(card, { number, words, where, sign, head, body, fields: null });
    return card;
  }

  // about: { key, trip, number, words, problems, trouble, pickedIn }
  function show(card, about) {
    const part = parts.get(card);
    const isOpen = about.key === opened;
    put(part.number, about.number);
    put(part.words, about.words);
    put(part.where, about.target ? `${metres(about.target)} m` : "no place yet");
    fill(part.sign, about.trouble && h("span", { class: "chip warn" }, icon("warning"), "To mend"));
    set(part.head, "aria-expanded", String(isOpen));
    card.classList.toggle("chosen", isOpen);
    if (isOpen && !part.fields) fill(part.body, (part.fields = tripFields(app, about, act, shift)).element);
    if (isOpen) part.fields.update(about, isLocked, shownTrips);
    else if (part.fields) part.fields = fill(part.body) && null;
  }

  // Scrolls the list, but never the page: the map stays where it is.
  function seen(card) {
    const [box, all] = [card.getBoundingClientRect(), element.getBoundingClientRect()];
    const below = Math.min(box.bottom - all.bottom, box.top - all.top);
    if (below > 0 || box.top < all.top) element.scrollTop += below > 0 ? below : box.top - all.top;
  }
  const cardOf = (key) => element.querySelector(`[data-key="${key}"]`);

  return {
    element,
    update(trips, chosen, locked) {
      const isOther = chosen !== opened;
      [shownTrips, opened, isLocked] = [trips, chosen, locked];
      element.classList.toggle("locked", locked);
      keyed(element, trips, ({ key }) => key, make, show);
      const card = chosen && cardOf(chosen);
      if (isOther && card) seen(card);
    },
    focus: (key) => cardOf(key)?.querySelector(".trip-head").focus(),
    fillIn: (key) => cardOf(key)?.querySelector("input")?.focus(),
  };
}

function tripFields(app, { key, trip: { action } }, act, shift) {
  const { parameters = [], item } = app.actions.find(({ name }) => name === action) ?? {};
  const fields = [];
  const field = (spec, about, value, change) => {
    const one = fieldFor(spec, { evaluators: app.evaluators, change });
    fields.push({ one, about, value });
    return one;
  };
  let target = null;
  const [x, y] = ["x (m)", "y (m)", "Height (m)"].map((label, axis) => {
    const spec = { name: label[0], label, type: "float", default: [null, null, app.map.cruise_height][axis] };
    return field(spec, "", (trip) => trip.target?.[axis], (value, typing) => {
      const now = [...(target ?? [0, 0])];
      now[axis] = value;
      if (axis === 2 && value === undefined) now.pop();
      // what is not finished changes nothing
      if (now.every((one) => typeof one === "number")) act.set(key, "target", now, typing);
    });
  });
  const name = field({ name: "name", type: "text" }, "name", (trip) => trip.name,
    (value, typing) => act.set(key, "name", value, typing));
  const inside = (part, spec, about) => field(spec, `${part}.${about}`, (trip) => trip[part]?.[about],
    (value, typing) => act.setIn(key, part, about, value, typing));
  const releases = action === RELEASE;
  if (item && !releases) {
    inside("item", { name: "item", type: "text" }, "name");
    inside("item", MASS, "mass");
  }
  for (const parameter of parameters) inside("parameters", parameter, parameter.name);
  for (const own of app.fields.trip) {
    field(own, own.name, (trip) => trip[own.name], (value, typing) => act.set(key, own.name, value, typing));
  }
  const known = fields.map(({ about }) => about);
  const troubles = h("div", { class: "wide" });
  const carried = h("p", { class: "wide hint carried" });
  const button = (text, onclick) => h("button", { class: "button small", onclick }, text);
  const up = button("Earlier", () => shift(key, -1));
  const down = button("Later", () => shift(key, 1));
  const foot = h("div", { class: "row wide" }, up, down,
    button("Copy", () => act.copy(key)), button("Delete", () => act.remove(key)));

  return {
    element: h("div", { class: "trip-body" }, troubles, releases && carried,
      fields.map(({ one }) => one.element), foot),
    update({ trip, number, problems, pickedIn, ...about }, locked, all) {
      target = about.target;
      const at = (where) => problems.filter((one) => one.field === where).map(({ text }) => text);
      for (const { one, about: where, value } of fields) {
        one.update(value({ ...trip, target }), { problem: at(where).join(" "), locked });
      }
      name.input.placeholder = number;
      for (const { input } of [x, y]) set(input, "aria-invalid", at("target").length ? "true" : null);
      fill(troubles, problems.filter((one) => !known.includes(one.field)).map(({ text }) => problemLine(text)));
      put(carried, pickedIn
        ? `Puts down “${trip.item?.name ?? ""}”${trip.item?.mass ? ` (${trip.item.mass})` : ""}, which trip `
          + `${pickedIn} picks.`
        : "Put a trip with “Pick item” before this one: then this one knows its item.");
      shown(foot, !locked);
      up.disabled = number === 1;
      down.disabled = number === all.length;
    },
  };
}
