// The trips of the selected mission: what one can do to them, and their cards, in the order of the
// flights; the chosen one is open.

import { inMission, moved, withField } from "./api.js";
import {
  button, fieldFor, fill, h, icon, keyed, newKey, put, reorderable, set, shown, unique,
} from "./dom.js";
import { actionSign, called, metres } from "./placing.js";

const PICK = "pick_item";
const RELEASE = "release_item";

// For the key of each release, the place in the list of the pick whose item it puts down.
export function picks(trips) {
  const found = new Map();
  let open = null;
  trips.forEach(({ key, action }, at) => {
    if (action === PICK) open = at;
    if (action !== RELEASE) return;
    if (open !== null) found.set(key, open);
    open = null;
  });
  return found;
}

function linked(trips) {
  const from = picks(trips);
  return trips.map((trip) =>
    from.has(trip.key) ? { ...trip, item: trips[from.get(trip.key)].item } : trip);
}

export function tripActs({ plan, selected, say, hush }, choose, focus) {
  const mission = () => selected.mission();
  const at = (key) => mission().trips.findIndex((trip) => trip.key === key);
  // change: trips → trips; what it needs it finds by key, as others may have changed the plan
  const edit = (change, typing = false, { key } = mission()) =>
    plan.edit(inMission(key, (now) => ({ ...now, trips: linked(change(now.trips)) })), typing);
  const inTrip = (key, change, typing) =>
    edit((trips) => trips.map((trip) => (trip.key === key ? change(trip) : trip)), typing);
  const has = (trips, { key }) => trips.some((other) => other.key === key);
  const put = (trip, index, where) =>
    edit((trips) => (has(trips, trip) ? trips : trips.toSpliced(index, 0, trip)), false, where);

  return {
    add(action, target) {
      const trips = mission()?.trips;
      if (!trips) return;
      const count = trips.filter((trip) => trip.action === PICK).length;
      // how heavy an item is, only people know
      const item = action.item ? { name: count ? `item ${count + 1}` : "item" } : null;
      const trip = { key: newKey(), action: action.name, target, parameters: {}, item };
      put(trip, trips.length);
      choose(trip.key);
      hush(`Trip ${trips.length + 1}, ${called(action.name)}, is on the map.`);
    },
    set: (key, name, value, typing) => inTrip(key, (trip) => withField(trip, name, value), typing),
    setIn: (key, part, name, value, typing) => inTrip(key, (trip) =>
      ({ ...trip, [part]: withField(trip[part] ?? {}, name, value) }), typing),
    place(key, target) {
      inTrip(key, (trip) => ({ ...trip, target: [...target, ...trip.target.slice(2)] }), true);
      hush(`${target.join(", ")} metres.`);
    },
    move(key, to) {
      if (to < 0 || to >= mission().trips.length) return;
      edit((trips) => moved(trips, key, to));
      hush(`It is trip ${to + 1} now.`);
    },
    copy(key) {
      const { name: _, ...trip } = mission().trips[at(key)] ?? {}; // no two trips have one name
      if (!trip.key) return;
      const fresh = { ...trip, key: newKey() };
      put(fresh, at(key) + 1);
      choose(fresh.key);
    },
    remove(key) {
      const where = mission();
      const index = at(key);
      const trip = where.trips[index];
      if (!trip) return; // somebody else was faster
      edit((trips) => trips.filter((other) => other.key !== key));
      const next = mission().trips[index] ?? mission().trips.at(-1);
      choose(next?.key ?? null);
      if (next) requestAnimationFrame(() => focus(next.key));
      say(`Trip ${index + 1}, ${called(trip.action)}, is deleted.`, {
        undo() {
          put(trip, index, where);
          selected.set(where.key);
          choose(key);
        },
      });
    },
  };
}

const MASS = { name: "mass", type: "mass", units: ["g", "mg", "kg"] };

export const problemLine = (text) =>
  h("p", { class: "problem" }, icon("warning"), h("span", {}, text));

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
      class: "trip-head", "aria-controls": id,
      onclick: () => act.choose(key === opened ? null : key),
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
    if (!isOpen) {
      part.fields = fill(part.body) && null;
      return;
    }
    part.fields ??= tripFields(app, about, act, shift);
    if (!part.body.firstChild) part.body.append(part.fields.element);
    part.fields.update(about, isLocked, shownTrips);
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
      // the list may be scrolled, but never the page: the map stays where it is
      if (isOther && card && element.scrollHeight > element.clientHeight) {
        card.scrollIntoView({ block: "nearest" });
      }
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
    const usual = axis === 2 ? app.map.cruise_height : null;
    const spec = { name: label[0], label, type: "float", default: usual };
    return field(spec, "", (trip) => trip.target?.[axis], (value, typing) => {
      const now = [...(target ?? [0, 0])];
      now[axis] = value;
      if (axis === 2 && value === undefined) now.pop();
      // what is not finished changes nothing
      if (now.every((one) => typeof one === "number")) act.set(key, "target", now, typing);
    });
  });
  const inside = (part, spec, name) => field(spec, `${part}.${name}`, (trip) => trip[part]?.[name],
    (value, typing) => act.setIn(key, part, name, value, typing));
  const own = (spec) => field(spec, spec.name, (trip) => trip[spec.name],
    (value, typing) => act.set(key, spec.name, value, typing));
  const name = own({ name: "name", type: "text" });
  const releases = action === RELEASE;
  if (item && !releases) {
    inside("item", { name: "item", type: "text" }, "name");
    inside("item", MASS, "mass");
  }
  for (const parameter of parameters) inside("parameters", parameter, parameter.name);
  app.fields.trip.forEach(own);
  const known = fields.map(({ about }) => about);
  const troubles = h("div", { class: "wide" });
  const carried = h("p", { class: "wide hint carried" });
  const up = button("Earlier", () => shift(key, -1), "small");
  const down = button("Later", () => shift(key, 1), "small");
  const foot = h("div", { class: "row wide" }, up, down,
    button("Copy", () => act.copy(key), "small"), button("Delete", () => act.remove(key), "small"));

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
      if (at("target").length) for (const { input } of [x, y]) set(input, "aria-invalid", "true");
      fill(troubles, problems.filter((one) => !known.includes(one.field))
        .map(({ text }) => problemLine(text)));
      const mass = trip.item?.mass ? ` (${trip.item.mass})` : "";
      put(carried, pickedIn
        ? `Puts down “${trip.item?.name ?? ""}”${mass}, which trip ${pickedIn} picks.`
        : "Put a trip with “Pick item” before this one: then this one knows its item.");
      shown(foot, !locked);
      up.disabled = number === 1;
      down.disabled = number === all.length;
    },
  };
}
