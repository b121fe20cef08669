// The page Monitor: missions, map, drones, the app's graph, console and results, side by side on a
// laptop and below each other on a tablet.

import { download } from "./api.js";
import { bell, fill, h, keyed, many, put, set, shown } from "./dom.js";
import { droneList, onTheMap } from "./drones.js";
import { floorPlan } from "./floor.js";
import { graphView } from "./graph.js";
import { consoleView, resultsView } from "./results.js";
import { missionTable, question } from "./table.js";

const WIDE = matchMedia("(min-width: 1160px)");
const OFTEN = 250; // ms: what nobody reads ten times a second is written so often

// Which mission is looked at: the table, the map and the graph show the same.
function choice({ plan, selected }) {
  const chosen = { name: null, changed: bell() };
  chosen.set = (name) => {
    if (name === chosen.name) return;
    chosen.name = name;
    const drawn = plan.missions.find((mission) => mission.name === name);
    if (drawn) selected.set(drawn.key);
    chosen.changed.ring();
  };
  return chosen;
}

// A part of the page, which its heading folds away; what was folded stays so.
function panel(id, title, { tools = [], body }) {
  const key = `pluto-folded-${id}`;
  const inside = h("div", { class: "inside", id: `${id}-inside` }, body);
  const beside = h("div", { class: "tools" }, tools);
  const toggle = h("button", {
    class: "fold", "aria-controls": inside.id, onclick: () => fold(!inside.hidden),
  }, h("span", { class: "arrow" }), title);
  const element = h("section", { class: `panel ${id}`, "aria-label": title },
    h("div", { class: "panel-head" }, h("h2", null, toggle), beside), inside);
  function fold(yes) {
    for (const each of [inside, beside]) shown(each, !yes);
    set(toggle, "aria-expanded", String(!yes));
    if (yes) sessionStorage.setItem(key, "yes");
    else sessionStorage.removeItem(key);
  }
  fold(sessionStorage.getItem(key) !== null);
  return element;
}

function questions(context) {
  const [heading, list] = [h("h2"), h("div")];
  const element = h("section", { class: "questions", role: "alert", hidden: true }, heading, list);
  element.update = () => {
    const rows = [...context.live.missions.values()].filter((row) => row.question);
    keyed(list, rows, (row) => `${row.name} ${row.question.text}`, (row) => question(context, row));
    put(heading, rows.length === 1 ? "A mission waits for you"
      : `${many(rows.length, "mission")} wait for you`);
    shown(element, rows.length);
  };
  return element;
}

export function monitor(context) {
  const { live, app } = context;
  const chosen = choice(context);
  const floor = floorPlan(app.map, app.drones);
  const save = (path) => h("button", {
    class: "button quiet small",
    onclick: async () => {
      try {
        await download(path, path.split("/").pop());
      } catch (error) {
        context.say(error.message, { bad: true });
      }
    },
  }, "Download");
  const table = missionTable(context, chosen);
  const map = onTheMap(context, floor, chosen);
  const drones = droneList(context, chosen);
  const graph = app.graph && graphView(context, chosen);
  const log = consoleView(context, save);
  const results = resultsView(context, chosen, floor, save);
  const asked = questions(context);
  const panels = {
    missions: panel("watch-missions", "Missions", table),
    map: panel("watch-map", "Map", { body: floor.element }),
    graph: graph && panel("watch-graph", "What the app does", graph),
    drones: panel("watch-drones", "Drones", drones),
    log: panel("watch-log", "Console", log),
    results: panel("watch-results", "Results", results),
  };
  const columns = [h("div", { class: "column main" }), h("div", { class: "column side" })];
  const element = h("div", { class: "monitor" }, asked, columns);
  // Moved, not painted over: the order for the keyboard is the one that is seen.
  function arrange() {
    const order = WIDE.matches ? ["missions graph log", "map drones results"]
      : ["missions map graph drones log results", ""];
    order.forEach((names, i) => {
      fill(columns[i], names.split(" ").map((name) => panels[name] ?? null));
    });
  }
  arrange();
  WIDE.addEventListener("change", arrange);

  let [flight, rows] = [null, null];
  let visible = false;
  let timer = 0;
  let seen = { log: 0, results: 0 };
  function newer(kind) {
    const list = live[kind];
    const first = list.findLastIndex((entry) => entry[0] <= seen[kind]) + 1;
    if (list.length) [seen[kind]] = list.at(-1);
    return list.slice(first);
  }
  function later() {
    timer = 0;
    drones.update();
    log.update(newer("log"));
    results.update(newer("results"));
  }
  function write(changes) {
    const again = live.flight === flight ? chosen.name : null;
    const anew = live.missions !== rows; // another flight, or the station was started again
    if (anew) {
      [flight, rows] = [live.flight, live.missions];
      seen = { log: 0, results: 0 };
      chosen.set(null);
      for (const each of [table, map, drones, graph, log, results]) each?.clear();
      changes = { missions: new Set(live.missions.keys()), drones: new Set(live.drones.keys()) };
    }
    for (const each of [table, map, graph]) each?.update(changes);
    if (anew && rows.has(again)) chosen.set(again);
    if (changes.missions.size) asked.update();
    timer ||= setTimeout(later, OFTEN);
  }
  return {
    element,
    update: (_, changes) => visible && write(changes),
    // What came while another page was open is made up for.
    show() {
      visible = true;
      write({ missions: new Set(live.missions.keys()), drones: new Set(live.drones.keys()) });
    },
    hide() {
      visible = false;
    },
  };
}
