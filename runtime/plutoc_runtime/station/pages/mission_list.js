// The missions in their order, one of them selected: a list for mouse, finger and keyboard.
//
//   const list = missionList({ select(key), open(key), rename(), remove(key), move(key, to) });
//   list.element   list.update(missions, selectedKey, problems)   list.focus()

import { fill, h, keyed, put, set, unique } from "./dom.js";
import { icon } from "./icons.js";
import { inWords, TIME } from "./quantities.js";
import { reorderable } from "./reorder.js";
import { many, plain } from "./words.js";

function about(mission, fields) {
  const given = fields
    .filter(({ name }) => mission[name] !== undefined && mission[name] !== null)
    .map(({ name, label, type }) => {
      const value = mission[name] === true ? "until stopped"
        : inWords(mission[name], type === "time" ? TIME : []);
      return `${label.toLowerCase()} ${plain(value)}`;
    });
  const trips = mission.trips.length ? many(mission.trips.length, "trip") : "no trips yet";
  return [trips, ...given].join(" · ");
}

function make() {
  return h("li", { class: "mission", role: "option", id: unique("mission") },
    h("span", { class: "grip", "aria-hidden": "true" }, icon("grip")),
    h("span", { class: "mission-number num", "aria-hidden": "true" }),
    h("span", { class: "mission-words" }, h("strong", {}), h("span", { class: "hint" })),
    h("span", { class: "signs" }));
}

const MARKS = {
  started: () => h("span", { class: "chip info" }, icon("lock"), "Started"),
  todo: () => h("span", { class: "chip" }, "To do"),
  mend: () => h("span", { class: "chip warn" }, icon("warning"), "To mend"),
  "": () => null,
};

// A mission that is only not finished yet has nothing wrong with it.
function marks(missions, problems) {
  const empty = new Set(missions.filter(({ trips }) => !trips.length).map(({ key }) => key));
  const found = new Map();
  for (const { mission, field } of problems) {
    const todo = empty.has(mission) && field === null && found.get(mission) !== "mend";
    found.set(mission, todo ? "todo" : "mend");
  }
  return found;
}

export function missionList(fields, { select, open, rename, remove, move }) {
  const element = h("ol", {
    class: "mission-list", role: "listbox", tabIndex: 0, "aria-label": "Missions",
    onkeydown: keys, onclick: (event) => on(event, select), ondblclick: (event) => on(event, open),
  });
  let missions = [];
  let selected = null;
  reorderable(element, (from, to) => {
    const { key } = missions[from];
    move(key, to);
    select(key);
  });

  function on(event, act) {
    const item = event.target.closest(".mission");
    const at = [...element.querySelectorAll(".mission")].indexOf(item);
    if (at >= 0) act(missions[at].key);
  }

  function keys(event) {
    const at = missions.findIndex((mission) => mission.key === selected);
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const to = { Home: 0, End: missions.length - 1 }[event.key]
      ?? (step && (at < 0 ? 0 : Math.max(0, Math.min(missions.length - 1, at + step))));
    if (event.altKey && step && at >= 0) move(selected, at + step);
    else if (to !== undefined) select(missions[to].key);
    else if (at < 0) return;
    else if (event.key === "Enter") open(selected);
    else if (event.key === "F2") rename();
    else if (event.key === "Delete") remove(selected);
    else return;
    event.preventDefault();
  }

  function show(node, mission, i, problems) {
    const [, number, what, signs] = node.children;
    put(number, i + 1);
    put(what.firstChild, mission.name.trim() || "Without a name");
    put(what.lastChild, about(mission, fields));
    const mark = mission.launched ? "started" : problems.get(mission.key) ?? "";
    if (signs.dataset.mark !== mark) {
      signs.dataset.mark = mark;
      fill(signs, MARKS[mark]());
    }
    const now = mission.key === selected;
    if (now && node.getAttribute("aria-selected") !== "true") {
      requestAnimationFrame(() => node.scrollIntoView({ block: "nearest" }));
    }
    set(node, "aria-selected", String(now));
    if (now) set(element, "aria-activedescendant", node.id);
  }

  return {
    element, focus: () => element.focus(),
    update(fresh, key, problems) {
      missions = fresh;
      selected = key;
      const bad = marks(missions, problems);
      if (key === null) set(element, "aria-activedescendant", null);
      keyed(element, missions, (mission) => mission.key, make,
        (node, mission, i) => show(node, mission, i, bad));
    },
  };
}
