// The page Trips: actions above the floor plan, the trips of the selected mission beside it. What is
// done to a pin is seen at its card at once, and the other way round: both show one list.

import { actions } from "./actions.js";
import { called } from "./action_signs.js";
import { fill, h, put, shown } from "./dom.js";
import { floorPlan } from "./floor.js";
import { icon } from "./dom.js";
import { missionPicker } from "./mission_picker.js";
import { ghostPin } from "./pin_ghost.js";
import { pins } from "./pins.js";
import { nearestHome, whyNot } from "./places.js";
import { problemLine, problemsOf } from "./problems.js";
import { tripActs } from "./trip_acts.js";
import { tripCards } from "./trip_cards.js";
import { picks } from "./trip_edits.js";
import { nothingToSet } from "./trips_hints.js";

export function trips(context) {
  const { app, plan, selected } = context;
  let chosen = null; // the key of a trip
  let draft = null; // { key, target } of a pin while it is dragged
  let asked = 0;

  const floor = floorPlan(app.map, app.drones);
  const choose = (key) => {
    if (key === chosen) return;
    chosen = key;
    const trip = selected.mission()?.trips.find((one) => one.key === key);
    if (trip?.target) floor.reveal(trip.target[0], trip.target[1]);
    draw();
  };
  const act = tripActs(context, { choose, focus: (key) => cards.focus(key) });
  const picker = missionPicker(context, { others: () => draw() });
  const ghost = ghostPin(floor, app.map);
  const palette = actions(app, floor, { add: act.add, hover: ghost.show });
  const cards = tripCards(app, { ...act, choose });
  const shownPins = pins(floor, {
    choose,
    drag(key, target) {
      draft = target && { key, target };
      draw();
    },
    place(key, target) {
      draft = null;
      act.place(key, target);
    },
    remove: act.remove,
    open: (key) => cards.fillIn(key),
  });
  ghost.raise();

  const title = h("h2", {});
  const troubles = h("div", { class: "stack" });
  const why = h("p", { class: "row locked" }, icon("lock"),
    h("span", {}, "This mission has been started, so its trips stay as they are. On the page ",
      h("button", { type: "button", class: "link", onclick: () => context.go("monitor") }, "Monitor"),
      " you can skip a trip, pause the mission or cancel it."));
  const empty = h("p", { class: "hint no-trips" },
    "No trips yet. Drag an action onto the map: that makes a trip. Its number is its turn.");
  const order = h("p", { class: "hint" }, "Drag a card, or press ", h("kbd", { class: "key" }, "Alt ↑"),
    " ", h("kbd", { class: "key" }, "Alt ↓"), ", to change the order. The line on the map shows the "
      + "order; drones find their own way around no-fly areas.");
  const side = h("section", { class: "card trips-side", "aria-label": "Trips of the mission" },
    title, why, troubles, empty, cards.element, order);
  const hint = nothingToSet(context);
  const main = h("div", { class: "trips-main" }, palette.element,
    h("div", { class: "trips-floor" }, floor.element));
  const element = h("div", { class: "trips" }, picker.element,
    h("div", { class: "trips-split" }, main, hint.element, side));

  function abouts(mission, found) {
    const from = picks(mission.trips);
    return mission.trips.map((kept, at) => {
      const dragged = draft?.key === kept.key;
      const height = kept.target?.slice(2) ?? [];
      const trip = dragged ? { ...kept, target: [...draft.target, ...height] } : kept;
      const all = found.trips.get(kept.key) ?? [];
      const here = trip.target ? whyNot(app.map, trip.target) : "";
      const pick = from.get(kept.key);
      const isTold = (field) => ((dragged || here) && field === "target")
        || (pick !== undefined && field?.startsWith("item.")); // the trip that picks it tells that
      const problems = all.filter(({ field }) => !isTold(field));
      const place = here || problems.find(({ field }) => field === "target")?.text || "";
      const trouble = [place, ...problems.map(({ text }) => text)].find(Boolean) ?? "";
      return {
        key: trip.key, trip, number: at + 1, target: trip.target, place, problems, trouble,
        words: trip.name ? `${called(trip.action)} · ${trip.name}` : called(trip.action), dragged,
        pickedIn: pick === undefined ? null : pick + 1,
      };
    });
  }

  function draw() {
    asked ||= requestAnimationFrame(now);
  }

  function now() {
    asked = 0;
    const mission = selected.mission();
    const locked = !mission || mission.launched;
    const found = problemsOf(plan, mission?.key);
    const list = mission ? abouts(mission, found) : [];
    if (!list.some(({ key }) => key === chosen)) chosen = null;
    const first = list.find(({ target }) => target)?.target;
    picker.update();
    hint.update();
    palette.lock(locked);
    for (const part of [side, palette.element]) shown(part, mission);
    shownPins.update({ trips: list, chosen, locked, home: first && nearestHome(app.drones, first) });
    shownPins.others(picker.othersShown() || !mission ? places(mission) : []);
    if (!mission) return;
    put(title, `Trips of ${mission.name.trim() || "a mission without a name"}`);
    shown(why, mission.launched);
    shown(palette.element, !mission.launched);
    shown(empty, !list.length);
    shown(order, list.length > 1 && !locked && chosen === null);
    fill(troubles, found.own.filter(({ field }) => field !== "name" && list.length)
      .map(({ text }) => problemLine(text)));
    cards.update({ trips: list, chosen, locked });
  }

  const places = (mission) => plan.missions.filter((other) => other !== mission)
    .flatMap((other) => other.trips.map((trip, at) =>
      [`${other.name}, trip ${trip.name ?? at + 1}`, trip.target]))
    .filter(([, target]) => target);

  plan.changed.heard(draw);
  selected.changed.heard(() => {
    chosen = null;
    draft = null;
    draw();
  });
  const head = document.querySelector(".top");
  new ResizeObserver(() => element.style.setProperty("--above", `${head.offsetHeight}px`)).observe(head);
  now();
  return { element, show: draw };
}
