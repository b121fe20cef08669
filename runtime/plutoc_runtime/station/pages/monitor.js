// The page one watches: missions, map, drones, the app's graph, console and results, side by side
// on a laptop and below each other on a tablet.
import { air } from "./air.js";
import { choice } from "./chosen.js";
import { consoleView } from "./console.js";
import { h } from "./dom.js";
import { fleetList } from "./fleet.js";
import { floorPlan } from "./floor.js";
import { gathered } from "./gathered.js";
import { graphView } from "./graph.js";
import { panel } from "./panel.js";
import { questions } from "./questions.js";
import { resultsView } from "./results.js";
import { missionTable } from "./table.js";
import { targets } from "./targets.js";

const WIDE = matchMedia("(min-width: 1060px)");
const FEW = 8; // drones whose names have room on the map

export function monitor(context) {
  const { app } = context;
  const chosen = choice();
  const floor = floorPlan(app.map, app.drones);
  const asked = questions(context);
  const table = missionTable(context, app, chosen, () =>
    context.plan.missions.length
      ? "Nothing flies yet. Press Start, and each mission has a line here."
      : "There are no missions yet. Make some on the Missions page first.",
  );
  const going = targets(floor, chosen);
  const flying = air(floor, chosen);
  floor.element.classList.toggle("few", app.drones.length <= FEW);
  const fleet = fleetList(context, app, chosen);
  const graph = app.graph && graphView(app.graph, chosen);
  const log = consoleView(context);
  const results = resultsView(context, app, floor, chosen);

  const later = {
    drones: gathered(fleet.update, "id"),
    log: gathered(log.update),
    results: gathered(results.update),
  };

  const panels = {
    table: panel("missions-panel", "Missions", { tools: [table.tools], body: [table.element] }),
    map: panel("map-panel", "Map", { body: [floor.element] }),
    graph: graph && panel("graph-panel", "What the app does", { body: [graph.element] }),
    drones: panel("drones-panel", "Drones", { body: [fleet.element] }),
    log: panel("log-panel", "Console", { tools: [log.tools], body: [log.element] }),
    results: panel("results-panel", "Results", {
      tools: [results.tools],
      body: [results.element],
    }),
  };
  const left = h("div", { class: "column main" });
  const right = h("div", { class: "column side" });
  const element = h("div", { class: "monitor" }, asked.element, left, right);
  // The order of the page is the order for the keyboard, too: so panels are moved, not painted over.
  const arrange = () => {
    const columns = WIDE.matches
      ? [["table", "graph", "log"], ["map", "drones", "results"]]
      : [["table", "map", "graph", "drones", "log", "results"], []];
    [left, right].forEach((column, index) => {
      const those = columns[index].map((name) => panels[name]).filter(Boolean);
      column.append(...those.map((each) => each.element));
    });
  };
  arrange();
  WIDE.addEventListener("change", arrange);

  let flight = null;
  let shown = false;
  let seen = { log: 0, results: 0 };
  const newer = (list, kind) => {
    const first = list.findLastIndex((entry) => entry[0] <= seen[kind]) + 1;
    if (list.length) seen[kind] = list.at(-1)[0];
    return list.slice(first);
  };
  const write = (live, missions, drones) => {
    asked.update(missions);
    table.update(missions, drones, live.state);
    flying.update(drones, live.state);
    going.update(missions, drones);
    later.drones.add(drones);
    graph?.update(missions);
    later.log.add(newer(live.log, "log"));
    later.results.add(newer(live.results, "results"));
  };
  const everything = (live) => write(live, [...live.missions.values()], [...live.drones.values()]);
  const clear = () => {
    seen = { log: 0, results: 0 };
    chosen.set(null);
    const views = [asked, table, flying, going, fleet, graph, log, results];
    for (const each of [...Object.values(later), ...views]) each?.clear();
  };
  // What came while another page was open is made up for when this one is shown.
  const update = (live, changes) => {
    if (!shown) return;
    if (live.flight !== flight) {
      flight = live.flight;
      clear();
      everything(live);
      return;
    }
    const those = (all, names) => [...names].map((name) => all.get(name)).filter(Boolean);
    write(live, those(live.missions, changes.missions), those(live.drones, changes.drones));
  };
  const show = () => {
    shown = true;
    if (context.live.flight !== flight) {
      flight = context.live.flight;
      clear();
    }
    everything(context.live);
  };
  const hide = () => {
    shown = false;
  };
  return { element, show, hide, update };
}
