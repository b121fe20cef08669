// A row a mission: sorted, filtered, and only written where something changed.

import { h, keyed, put, set, shown } from "./dom.js";
import { ended, missionRow, needsYou } from "./row.js";

const URGENT = ["FAILED", "PAUSED", "RUNNING", "STANDBY", "UNEXECUTED", "COMPLETED", "CANCELLED"];
const COLUMNS = {
  Mission: (row) => row.index,
  State: (row) => (needsYou(row) ? -1 : URGENT.indexOf(row.status)),
  Trip: (row) => row.done / (row.total || 1),
  Drone: (row) => row.drone ?? "\uffff",
  Attempt: (row) => row.attempt,
  Round: (row) => row.round,
};
const FILTERS = {
  All: () => true,
  "Under way": (row) => !ended(row) && !needsYou(row),
  "Waiting for you": needsYou,
  Failed: (row) => row.status === "FAILED",
};
const HEAD = 41; // pixels of the heads, which stay above the rows
const MANY = 12; // missions: of more, one wants to find one by its name

// Some buttons of which one is pressed; `count(name, n)` writes how many there are behind one.
export function sieve(names, label, picked) {
  const buttons = new Map(names.map((name) => [name, h("button", {
    class: "sift", "aria-pressed": "false", onclick: () => pick(name),
  }, name, " ", h("span", { class: "count" }, "0"))]));
  const element = h("div", { role: "group", "aria-label": label }, ...buttons.values());
  const pick = (name) => {
    for (const [other, button] of buttons) set(button, "aria-pressed", String(other === name));
    picked(name);
  };
  element.pick = pick;
  element.count = (name, number) => {
    put(buttons.get(name).lastChild, number);
    set(buttons.get(name), "data-any", number > 0);
  };
  return element;
}

export function missionTable(context, chosen) {
  const { live, app } = context;
  const rows = new Map();
  const body = h("div", { role: "rowgroup" });
  const empty = h("p", { class: "empty" });
  const find = h("input", {
    type: "search", class: "input", placeholder: "Find a mission", "aria-label": "Find a mission",
    oninput: () => sift(), hidden: true,
  });
  let filter = FILTERS.All;
  const filters = sieve(Object.keys(FILTERS), "Which missions", (name) => {
    filter = FILTERS[name];
    sift();
  });
  const columns = Object.keys(COLUMNS).filter((name) => (name !== "Attempt" || app.retries)
    && (name !== "Round" || app.rounds));
  let [by, down] = ["Mission", false];
  const heads = columns.map((name) => h("div", { role: "columnheader" }, h("button", {
    onclick: () => {
      [by, down] = [name, by === name && !down];
      arrange();
    },
  }, name)));
  const table = h("div", {
    class: `watch-table columns-${columns.length}`, role: "table", "aria-label": "Missions",
  }, h("div", { class: "table-head", role: "rowgroup" },
    h("div", { class: "mission-row", role: "row" }, heads)), body);

  function arrange() {
    heads.forEach((head, i) => {
      set(head, "aria-sort", columns[i] !== by ? "none" : down ? "descending" : "ascending");
    });
    const order = COLUMNS[by];
    const sorted = [...rows.values()].sort((a, b) => {
      const [first, second] = [order(a.row), order(b.row)];
      const less = first < second ? -1 : Number(first > second);
      return (down ? -less : less) || a.row.index - b.row.index;
    });
    keyed(body, sorted, (row) => row, (row) => row);
  }
  function sift() {
    const text = find.value.trim().toLowerCase();
    const all = [...rows.values()];
    let seen = 0;
    for (const row of all) {
      const fits = filter(row.row) && row.row.name.toLowerCase().includes(text);
      seen += fits;
      shown(row, fits);
    }
    for (const [name, test] of Object.entries(FILTERS)) {
      filters.count(name, all.filter(({ row }) => test(row)).length);
    }
    shown(find, all.length > MANY || text);
    shown(empty, !seen);
    if (seen) return;
    put(empty, all.length ? "No mission is like that now."
      : context.plan.missions.length ? "Press Start, and each mission has a line here."
        : "There are no missions yet. Make some on the page Missions.");
  }
  // The list is scrolled, never the page: who presses a number in the graph goes on seeing it.
  function reveal(row) {
    const list = body.closest(".inside");
    if (!row || !list) return;
    const [top, under] = [row.offsetTop - HEAD, row.offsetTop + row.offsetHeight];
    if (under > list.scrollTop + list.clientHeight) list.scrollTop = under - list.clientHeight;
    if (top < list.scrollTop) list.scrollTop = top;
  }
  let soon = 0;
  // While somebody is in the table, rows do not change places under their hands.
  function arrangeSoon() {
    soon ||= setTimeout(() => {
      soon = 0;
      if (body.contains(document.activeElement) || body.matches(":hover")) arrangeSoon();
      else arrange();
    }, 1000);
  }
  let [time, phase] = [0, ""];
  function update({ missions, drones }) {
    const before = rows.size;
    for (const name of missions) {
      if (!rows.has(name)) rows.set(name, missionRow(context, name, chosen));
      rows.get(name).show(live.missions.get(name), live);
    }
    for (const id of drones) {
      const row = rows.get(live.drones.get(id).mission);
      if (row?.row.drone === id) row.charge(live);
    }
    if (phase !== live.state.phase) {
      ({ phase } = live.state);
      rows.get(chosen.name)?.show(live.missions.get(chosen.name), live);
    }
    if (time !== (time = Math.floor(live.state.time))) {
      for (const row of rows.values()) if (row.row.until !== null) row.tick(live);
    }
    if (rows.size !== before) arrange();
    else if (missions.size && by !== "Mission") arrangeSoon();
    if (missions.size || !rows.size) sift();
  }
  function clear() {
    rows.clear();
    arrange();
    sift();
  }
  chosen.changed.heard(() => {
    for (const [name, row] of rows) row.open(name === chosen.name);
    reveal(rows.get(chosen.name));
  });
  body.addEventListener("keydown", (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step || !event.target.matches(".opener")) return;
    event.preventDefault();
    const openers = [...body.querySelectorAll(".entry:not([hidden]) .opener")];
    openers[openers.indexOf(event.target) + step]?.focus();
  });
  filters.pick("All");
  return { tools: [find, filters], body: [table, empty], update, clear };
}
