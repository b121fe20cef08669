// The selected mission: its name, the fields that the app's graph needs, its trips in short.
//
//   const panel = missionPanel(context, { open, copy, remove, move });
//   panel.element   panel.update(mission, problems, index, count)   panel.rename()

import { fill, h, keyed, put, shown } from "./dom.js";
import { fieldFor } from "./fields.js";
import { icon } from "./icons.js";
import { setField } from "./plan_edits.js";
import { many, plain } from "./words.js";

const SHOWN = 12; // trips
const NO_TRIPS = "No trips yet. “Set trips” opens the map: drag actions onto it there.";

function button(sign, text, onclick, kind = "") {
  return h("button", { class: `button ${kind}`, onclick }, icon(sign), h("span", {}, text));
}

function arrow(sign, text, onclick) {
  return h("button", { class: "button icon", "aria-label": text, title: text, onclick },
    icon(sign));
}

function tripLine(trip, i, problem) {
  const place = trip.target?.slice(0, 2).map((number) => Number(number).toFixed(1)).join(", ");
  return h("li", {}, h("span", { class: "mission-number num" }, i + 1),
    h("span", { class: "mission-words" }, h("strong", {}, trip.name ?? `Trip ${i + 1}`), " ",
      h("span", { class: "muted" }, plain(trip.action ?? "no action yet"),
        place ? ` at ${place} m` : " without a place yet"),
      problem && h("span", { class: "problem" }, icon("warning"), problem.text)));
}

function tripsInShort() {
  const list = h("ol", { class: "trips-short" });
  const more = h("p", { class: "hint" });
  return {
    element: h("div", { class: "stack" }, list, more),
    update(trips, problems) {
      const some = trips.slice(0, SHOWN);
      keyed(list, some.map((trip, i) => ({ trip, i })), ({ trip, i }) => JSON.stringify([i, trip,
        problems.find((each) => each.trip === trip.key)?.text]),
      ({ trip, i }) => tripLine(trip, i, problems.find((each) => each.trip === trip.key)));
      put(more, trips.length > SHOWN ? `and ${trips.length - SHOWN} more`
        : trips.length ? "" : NO_TRIPS);
      shown(more, more.textContent);
    },
  };
}

export function missionPanel({ app, plan }, { open, copy, remove, move }) {
  let now = null;
  const edit = (name) => (value, typing) => {
    if (now) plan.edit(setField(now.key, name, name === "name" ? value ?? "" : value), typing);
  };
  const title = fieldFor({ name: "name", type: "text", label: "Name" }, { change: edit("name") });
  const set = button("map", "Set trips", () => open(now.key), "primary");
  title.element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    set.focus();
  });
  const inputs = app.fields.mission.map((field) => [field.name,
    fieldFor(field, { evaluators: app.evaluators, change: edit(field.name) })]);
  const trips = tripsInShort();
  const count = h("h3", {});
  const said = h("div", { class: "stack" });
  const locked = h("p", { class: "row" }, icon("lock"),
    "It has been started: it can be changed again when it has ended.");
  const up = arrow("up", "Move up", () => move(now.key, -1));
  const down = arrow("down", "Move down", () => move(now.key, 1));
  const bin = button("bin", "Delete", () => remove(now.key));
  const fields = h("div", { class: "mission-fields" }, inputs.map(([, input]) => input.element));
  const element = h("section", {
    class: "card mission-panel stack", "aria-label": "The selected mission",
  },
    locked, title.element, said, inputs.length > 0 && fields,
    h("div", { class: "row trips-head" }, count, set), trips.element,
    h("div", { class: "row panel-foot" }, up, down, h("span", { class: "spread row" },
      button("copy", "Copy", () => copy(now.key)), bin)));

  return {
    element,
    rename() {
      title.input.focus();
      title.input.select();
    },
    update(mission, problems, index, total) {
      const another = now?.key !== mission.key;
      now = mission;
      if (another && element.contains(document.activeElement)) document.activeElement.blur();
      const of = problems.filter((problem) => problem.mission === mission.key);
      const at = (name) => ({
        problem: of.find(({ trip, field }) => trip === null && field === name)?.text ?? "",
        locked: mission.launched,
      });
      title.update(mission.name, at("name"));
      for (const [name, input] of inputs) input.update(mission[name], at(name));
      const known = new Set(["name", ...inputs.map(([name]) => name)]);
      const general = of.filter(({ trip, field }) => trip === null && !known.has(field)
        && (field !== null || mission.trips.length > 0)); // no trips yet: said below
      const text = general.map((problem) => problem.text).join("\n");
      if (said.dataset.text !== text) {
        said.dataset.text = text;
        fill(said, general.map((problem) =>
          h("p", { class: "problem" }, icon("warning"), problem.text)));
      }
      put(count, mission.trips.length ? many(mission.trips.length, "trip") : "Trips");
      put(set.lastChild, mission.launched ? "See trips" : "Set trips");
      trips.update(mission.trips, of);
      shown(locked, mission.launched);
      up.disabled = index === 0;
      down.disabled = index === total - 1;
      bin.disabled = mission.launched;
    },
  };
}
