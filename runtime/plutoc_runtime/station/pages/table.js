// A row a mission: sorted, filtered, and only ever written where something changed.
import { h } from "./dom.js";
import { filters } from "./filters.js";
import { inOrder } from "./quick.js";
import { missionRow } from "./row.js";
import { ORDERS, ordered } from "./sorting.js";

export function missionTable(context, app, chosen, nothing) {
  const rows = new Map();
  const byDrone = new Map();
  const charges = new Map();
  const body = h("div", { class: "rows", role: "rowgroup" });
  const empty = h("p", { class: "empty" });
  let order = { key: "index", down: false };
  let time = 0;

  const columns = [["index", "Mission"], ["status", "State"], ["progress", "Trip"]];
  columns.push(["drone", "Drone"]);
  if (app.retries) columns.push(["attempt", "Attempt"]);
  if (app.rounds) columns.push(["round", "Round"]);
  const heads = columns.map(([key, label]) => {
    const arrow = h("span", { class: "sorted", "aria-hidden": "true" });
    const button = h("button", { type: "button", title: ORDERS[key].title }, label, arrow);
    const cell = h("div", { class: "m-cell", role: "columnheader" }, button);
    button.addEventListener("click", () => {
      order = { key, down: order.key === key && !order.down };
      arrange();
    });
    return { key, cell };
  });
  const head = h("div", { class: "mission-row", role: "row" }, ...heads.map((each) => each.cell));
  const table = h(
    "div",
    { class: "watch-table", role: "table", "aria-label": "Missions" },
    h("div", { class: "table-head", role: "rowgroup" }, head),
    body,
  );
  table.classList.toggle("has-retries", app.retries);
  table.classList.toggle("has-rounds", app.rounds);
  const shown = filters(() => sift());

  const arrange = () => {
    for (const { key, cell } of heads) {
      const sorted = key === order.key ? (order.down ? "descending" : "ascending") : "none";
      cell.setAttribute("aria-sort", sorted);
    }
    inOrder(body, ordered([...rows.values()], order).map((row) => row.element));
  };
  // Which rows the filter lets through.
  const sift = () => {
    let visible = 0;
    for (const row of rows.values()) {
      const passes = shown.passes(row.data);
      visible += passes;
      if (row.element.hidden === passes) row.element.hidden = !passes;
    }
    empty.hidden = visible > 0;
    empty.textContent = rows.size ? "No mission is like that now." : nothing();
  };

  let again = 0;
  // While somebody is in the table, rows do not change places under their hands.
  const arrangeSoon = () => {
    if (order.key === "index" || again) return;
    again = setTimeout(() => {
      again = 0;
      if (body.contains(document.activeElement) || body.matches(":hover")) arrangeSoon();
      else arrange();
    }, 1000);
  };

  const batteryOf = (id) => charges.get(id) ?? null;
  const update = (missions, drones, state) => {
    const before = rows.size;
    for (const drone of drones) {
      charges.set(drone.id, drone.battery);
      byDrone.get(drone.id)?.battery(drone.id, drone.battery);
    }
    for (const mission of missions) {
      let row = rows.get(mission.name);
      if (!row) {
        row = missionRow(context, app, mission.name, chosen);
        rows.set(mission.name, row);
      }
      if (row.data?.drone && byDrone.get(row.data.drone) === row) byDrone.delete(row.data.drone);
      row.show(mission, state.time, batteryOf);
      if (mission.drone !== null) byDrone.set(mission.drone, row);
    }
    if (Math.floor(state.time) !== time) {
      time = Math.floor(state.time);
      for (const row of rows.values()) if (row.data.until !== null) row.tick(state.time);
    }
    if (rows.size !== before) arrange();
    else if (missions.length) arrangeSoon();
    if (missions.length || !rows.size) {
      shown.count([...rows.values()].map((row) => row.data));
      sift();
    }
  };
  const clear = () => {
    for (const each of [rows, byDrone, charges]) each.clear();
    body.replaceChildren();
  };

  chosen.watch((name, before) => {
    rows.get(before)?.open(false);
    const row = rows.get(name);
    row?.open(true);
    if (row && !row.element.contains(document.activeElement)) {
      row.element.scrollIntoView({ block: "nearest" });
    }
  });
  body.addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step || !event.target.matches(".opener")) return;
    const openers = [...body.querySelectorAll(".entry:not([hidden]) .opener")];
    openers[openers.indexOf(event.target) + step]?.focus();
    event.preventDefault();
  });
  return { element: h("div", { class: "scrolls" }, table, empty), tools: shown.element, update, clear };
}
