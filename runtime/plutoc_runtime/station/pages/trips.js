// The page Trips: actions above the floor plan, the trips of the selected mission beside it. Pins
// and cards show one list, in which a pin is already where it is being dragged.

import { addMission, inMission, moved, withField } from "./api.js";
import {
  button, fieldFor, fill, h, icon, keyed, many, newKey, put, reorderable, set, shown, unique,
} from "./dom.js";
import { floorPlan, whyNot } from "./floor.js";
import { actions, actionSign, called, metres, pins } from "./placing.js";

const PICK = "pick_item";
const RELEASE = "release_item";
const MASS = { name: "mass", type: "mass", units: ["g", "mg", "kg"] };
const nameOf = ({ name }) => name.trim() || "Without a name";
const problemLine = (text) =>
  h("p", { class: "problem" }, icon("warning"), h("span", {}, text));

export function trips(context) {
  const { app, plan, selected } = context;
  let chosen = null; // the key of a trip
  let draft = null; // { key, target }: a pin while it is dragged
  let fresh = null; // { words, target }: where an action would be put now
  let asked = 0;
  let told = "";

  const floor = floorPlan(app.map, app.drones);
  function choose(key) {
    if (key === chosen) return;
    chosen = key;
    const trip = selected.mission()?.trips.find((one) => one.key === key);
    if (trip?.target) floor.reveal(...trip.target);
    draw();
  }
  const act = { ...tripActs(context, choose, (key) => cards.focus(key)), choose };
  const palette = actions(app, floor, {
    add: act.add,
    hover(action, target) {
      fresh = target && { target, words: `${metres(target)} m` };
      draw();
    },
  });
  const cards = tripCards(app, act);
  const shownPins = pins(floor, {
    ...act,
    drag(key, target) {
      draft = target && { key, target };
      draw();
    },
    place(key, target) {
      draft = null;
      act.place(key, target);
    },
    open: cards.fillIn,
  });

  const newMission = (kind) => button("New mission", () => {
    const key = newKey();
    plan.edit(addMission(key));
    selected.set(key);
  }, kind, "plus");
  const id = unique("mission");
  const picker = h("select", {
    id, class: "input", onchange: () => selected.set(picker.value || null),
  });
  const tick = h("input", { type: "checkbox", onchange: () => draw() });
  const others = h("label", { class: "check spread" }, tick, "Show other missions");
  const bar = h("div", { class: "row mission-bar" }, h("label", { for: id }, "Mission"), picker,
    newMission(""), others);

  const title = h("h2");
  const why = h("p", { class: "hint" }, icon("lock"), " This mission has been started, so its "
    + "trips stay as they are. On the page Monitor you can skip a trip, or pause or cancel it.");
  const troubles = h("div");
  const hint = h("p", { class: "hint" });
  const side = h("section", { class: "card trips-side", "aria-label": "Trips of the mission" },
    title, why, troubles, cards.element, hint);
  const first = h("section", { class: "card stack trips-first", "aria-label": "What to do first" });
  const element = h("div", { class: "trips" }, bar, h("div", { class: "trips-split" },
    h("div", { class: "trips-main" }, palette.element,
      h("div", { class: "trips-floor" }, floor.element)), first, side));

  function aboutOf(kept, at, mission, from) {
    const dragged = draft?.key === kept.key && draft.target;
    const target = dragged ? [...dragged, ...kept.target.slice(2)] : kept.target;
    const pick = from.get(kept.key);
    const problems = plan.problems.filter(({ trip, field }) => trip === kept.key
      && !(dragged && field === "target")
      && !(pick !== undefined && field?.startsWith("item."))); // the trip that picks it tells that
    const here = dragged && whyNot(app.map, dragged);
    if (here) problems.unshift({ field: "target", text: here });
    const words = dragged ? here || `${metres(dragged)} m`
      : [called(kept.action), ...(kept.name ? [kept.name] : [])].join(" · ");
    return {
      key: kept.key, trip: kept, number: at + 1, target, words, problems,
      trouble: problems[0]?.text ?? "", pickedIn: pick === undefined ? null : pick + 1,
    };
  }

  function now() {
    asked = 0;
    const mission = selected.mission();
    const locked = !mission || mission.launched;
    const from = picks(mission?.trips ?? []);
    const list = (mission?.trips ?? []).map((trip, at) => aboutOf(trip, at, mission, from));
    if (!list.some(({ key }) => key === chosen)) chosen = null;
    showPins(list, mission, locked);
    shown(bar, plan.missions.length);
    shown(others, plan.missions.length > 1);
    const choices = plan.missions.map((one) =>
      [one.key, `${nameOf(one)} (${many(one.trips.length, "trip")})`]);
    if (told !== JSON.stringify([choices, !mission])) { // else a list that is open would close
      told = JSON.stringify([choices, !mission]);
      fill(picker, h("option", { value: "", hidden: mission }, "Choose a mission"),
        choices.map(([value, text]) => h("option", { value }, text)));
      fill(first, mission ? [] : whatFirst());
    }
    picker.value = mission?.key ?? "";
    shown(first, plan.loaded && !mission);
    shown(side, mission);
    shown(palette.element, !locked);
    if (locked && fresh) palette.putBack();
    if (!mission) return;
    put(title, `Trips of ${nameOf(mission)}`);
    shown(why, mission.launched);
    fill(troubles, list.length > 0 && plan.problems.filter(({ mission: key, trip, field }) =>
      key === mission.key && !trip && field !== "name").map(({ text }) => problemLine(text)));
    put(hint, locked || chosen ? "" : !list.length
      ? "No trips yet. Drag an action onto the map: that makes a trip."
      : "Drag a card, or press Alt with ↑ or ↓, to change the order. The line on the map shows "
        + "it; drones find their own way around no-fly areas.");
    cards.update(list, chosen, locked);
  }

  function showPins(list, mission, locked) {
    const start = list.find(({ target }) => target)?.target;
    const far = ({ home: [x, y] }) => Math.hypot(x - start[0], y - start[1]);
    const nearest = start && app.drones.toSorted((a, b) => far(a) - far(b))[0];
    const trouble = fresh && whyNot(app.map, fresh.target);
    const more = fresh
      ? [{ ...fresh, key: "new", number: "+", trouble, words: trouble || fresh.words }] : [];
    shownPins.update({ trips: [...list, ...more], chosen, locked, home: nearest?.home });
    const faint = mission && !tick.checked ? [] : plan.missions.filter((one) => one !== mission);
    shownPins.showOthers(faint.flatMap((one) => one.trips.map(({ name, target }, at) =>
      [`${nameOf(one)}, trip ${name ?? at + 1}`, target])).filter(([, target]) => target));
  }

  const whatFirst = () => plan.missions.length ? [
    h("h2", {}, "First choose a mission"),
    h("p", {}, "Trips belong to a mission. Whose trips do you want to set?"),
    plan.missions.slice(0, 8).map((one) => button(nameOf(one), () => selected.set(one.key))),
  ] : [
    h("h2", {}, "First make a mission"),
    h("p", {}, "A mission is a list of trips; a trip is a flight to a place, and what is done "
      + "there. Make a mission, then drag actions onto the map."),
    newMission("primary"),
  ];

  function draw() {
    asked ||= requestAnimationFrame(now);
  }
  plan.changed.heard(draw);
  selected.changed.heard(() => {
    chosen = draft = null;
    draw();
  });
  now();
  return { element, show: draw };
}

// For the key of each release, the place in the list of the pick whose item it puts down.
function picks(trips) {
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

// What one can do to the trips of the selected mission.
function tripActs({ plan, selected, say, hush }, choose, focus) {
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

// The trips as cards, in their order; the chosen one is open.
function tripCards(app, act) {
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
