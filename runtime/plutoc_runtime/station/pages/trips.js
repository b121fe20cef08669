// The page Trips: actions above the floor plan, the trips of the selected mission beside it. Pins
// and cards show one list, in which a pin is already where it is being dragged.

import { addMission } from "./api.js";
import { button, fill, h, icon, many, newKey, put, shown, unique } from "./dom.js";
import { floorPlan } from "./floor.js";
import { actions, called, metres, pins } from "./placing.js";
import { picks, problemLine, tripActs, tripCards } from "./trip_cards.js";

const nameOf = ({ name }) => name.trim() || "Without a name";

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

  // What the page checks by itself, while something is dragged; the station has the last word.
  function whyNot([x, y]) {
    const [width, height] = app.map.size;
    if (x < 0 || y < 0 || x > width || y > height) return "Outside the map";
    return app.map.no_fly.some((area) => isInside(x, y, area)) ? "In a no-fly area" : "";
  }

  function aboutOf(kept, at, mission, from) {
    const dragged = draft?.key === kept.key && draft.target;
    const target = dragged ? [...dragged, ...kept.target.slice(2)] : kept.target;
    const pick = from.get(kept.key);
    const problems = plan.problems.filter(({ trip, field }) => trip === kept.key
      && !(dragged && field === "target")
      && !(pick !== undefined && field?.startsWith("item."))); // the trip that picks it tells that
    const here = dragged && whyNot(dragged);
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
    const trouble = fresh && whyNot(fresh.target);
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

function isInside(x, y, corners) {
  let within = false;
  corners.forEach(([ax, ay], at) => {
    const [bx, by] = corners.at(at - 1);
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) * (bx - ax)) / (by - ay)) within = !within;
  });
  return within;
}
