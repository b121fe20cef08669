// The table of missions: how each stands, what opens below it, and which are shown in which order.

import { fill, h, icon, keyed, plain, put, seconds, set, shown } from "./dom.js";

// A word with a sign, so that colour alone never says it.
const STANDS = {
  UNEXECUTED: ["Not started", "wait", "calm"],
  RUNNING: ["Flying", "start", "busy"],
  STANDBY: ["Waiting", "wait", "calm"],
  COMPLETED: ["Completed", "good", "good"],
  FAILED: ["Failed", "bad", "bad"],
  PAUSED: ["Paused", "pause", "warn"],
  CANCELLED: ["Cancelled", "close", "calm"],
  UNCERTAIN: ["Needs you", "warning", "warn"],
  HELD: ["Needs you", "warning", "warn"],
  WAITING: ["To do", "wait", "calm"],
  EXECUTING: ["Flying", "start", "busy"],
  SKIPPED: ["Skipped", "close", "calm"],
  FREE: ["Ready", "good", "good"],
  BUSY: ["Flying", "start", "busy"],
  RETURNING: ["Coming home", "home", "busy"],
  CHARGING: ["Charging", "wait", "calm"],
  RECOVERING: ["Recovering", "wait", "warn"],
  LOST: ["Lost", "warning", "bad"],
  OFFLINE: ["Not connected", "info", "calm"],
  RETIRED: ["Retired", "close", "calm"],
};

export const ended = ({ status }) => ["COMPLETED", "FAILED", "CANCELLED"].includes(status);
const needsYou = ({ status }) => status === "UNCERTAIN" || status === "HELD";
export const round = (number) => Math.round(number * 100) / 100;

// An element whose `show(status)` writes another one.
export function standing() {
  const element = h("span", { class: "standing" });
  element.show = (status) => {
    if (element.dataset.status === status) return;
    element.dataset.status = status;
    const [word, sign, tone] = STANDS[status] ?? [status, "info", "calm"];
    set(element, "data-tone", tone);
    fill(element, icon(sign), word);
  };
  return element;
}

export const level = (charge) => (charge < 0.2 ? "low" : charge < 0.4 ? "middle" : "full");

// A small bar with its percentage; `show(null)` where nothing is known.
export function battery() {
  const bar = h("i");
  const text = h("span");
  const element = h("span", { class: "battery", hidden: true },
    h("span", { class: "bar", "aria-hidden": "true" }, bar), text);
  let before = null;
  element.show = (charge) => {
    const whole = charge === null || charge === undefined ? null : Math.round(charge * 100);
    if (whole === before) return;
    before = whole;
    shown(element, whole !== null);
    bar.style.width = `${whole}%`;
    set(element, "data-level", level(whole / 100));
    put(text, `${whole} %`);
  };
  return element;
}

// A row or a line that shows the chosen mission.
export const mark = (element, yes) => set(element, "data-chosen", yes && "yes");

// For what cannot be undone: the first press asks in place, the second one does it.
export function sureButton(label, act) {
  const button = h("button", { class: "button quiet small" }, label);
  const ask = (yes) => {
    set(button, "data-sure", yes);
    put(button, yes ? `Really ${label.toLowerCase()}?` : label);
  };
  button.addEventListener("blur", () => ask(false));
  button.addEventListener("click", () => {
    if (button.dataset.sure) act();
    ask(!button.dataset.sure);
  });
  return button;
}

const ANSWERS = { done: "It was done", "not-done": "It was not done", "go-on": "Go on" };

// What only a person can know, with its answers as buttons.
export function question(context, { name: mission, question: { text, answers } }) {
  const buttons = answers.map((answer) => {
    const decide = () => context.tell("decide", { mission, answer });
    if (answer === "cancel") return sureButton("Cancel mission", decide);
    return h("button", { class: "button", onclick: decide }, ANSWERS[answer] ?? answer);
  });
  return h("div", { class: "question" },
    h("p", null, h("strong", null, mission, ": "), text), h("div", { class: "row" }, buttons));
}

function tripLine(send, prioritised, name) {
  let priority = 1;
  const [nth, called, what] = [h("span", { class: "nth" }), h("span"), h("small")];
  const weight = h("output");
  const stands = standing();
  const step = (by, sign, label) => h("button", {
    class: "button quiet icon", "aria-label": `${label} the priority of trip ${name}`,
    onclick: () => send("prioritise", { trip: name, priority: priority + by }),
  }, sign);
  const weighs = h("span", { class: "weighs" }, "Priority", step(-1, "−", "Lower"), weight,
    step(1, "+", "Raise"));
  const skip = h("button", {
    class: "button quiet small", "aria-label": `Skip trip ${name}`,
    onclick: () => send("skip", { trip: name }),
  }, "Skip");
  const element = h("li", null, nth, h("span", { class: "called" }, called, what), stands,
    weighs, skip);
  element.show = ({ trip: [, status, x, y, number, action], index, current, over }) => {
    priority = number ?? 1;
    put(nth, `${index + 1}.`);
    put(called, name === String(index + 1) ? "" : name);
    put(what, `${plain(action)} at ${round(x)}, ${round(y)}`);
    stands.show(status);
    set(element, "aria-current", current && "step");
    const open = !over && status !== "COMPLETED" && status !== "SKIPPED";
    put(weight, priority);
    shown(weighs, open && prioritised && number !== null);
    shown(skip, open);
  };
  return element;
}

function details(context, name) {
  const send = (command, given) => context.tell(command, { mission: name, ...given });
  const prioritised = context.app.fields.trip.some((field) => field.name === "priority");
  let paused = false;
  const pause = h("button", {
    class: "button small", onclick: () => send(paused ? "go-on" : "pause"),
  });
  const buttons = h("div", { class: "row" }, pause,
    sureButton("Cancel mission", () => send("cancel")));
  const list = h("ol", { class: "trip-lines" });
  const element = h("div", { class: "details" }, list, buttons);
  element.show = (row) => {
    const over = ended(row) || context.live.state.phase !== "flying";
    paused = row.status === "PAUSED";
    put(pause, paused ? "Go on" : "Pause");
    shown(pause, !row.question);
    shown(buttons, !over);
    // A line belongs to its trip: what one is about to press never becomes another trip's.
    const seen = new Map();
    const lines = row.trips.map((trip, index) => {
      seen.set(trip[0], (seen.get(trip[0]) ?? 0) + 1);
      const key = `${seen.get(trip[0])} ${trip[0]}`;
      return { key, trip, index, current: index === row.current && !ended(row), over };
    });
    keyed(list, lines, (line) => line.key, (line) => tripLine(send, prioritised, line.trip[0]),
      (line, item) => line.show(item));
  };
  return element;
}

function missionRow(context, name, chosen) {
  const { retries, rounds } = context.app;
  const span = (kind) => h("span", { class: kind });
  const [number, why, trip, drone] = ["token", "why", "", ""].map(span);
  const stands = standing();
  const charge = battery();
  const bar = h("i");
  const opener = h("button", {
    class: "opener", "aria-expanded": "false",
    onclick: () => chosen.set(chosen.name === name ? null : name),
  }, h("span", { class: "arrow" }), number, h("span", { class: "called" }, name));
  const cells = [
    [opener], [stands, why], [trip, h("span", { class: "track" }, bar)], [drone, " ", charge],
    ...(retries ? [[""]] : []), ...(rounds ? [[""]] : []),
  ].map((inside) => h("div", { class: "cell", role: "cell" }, inside));
  const line = h("div", { class: "mission-row", role: "row", "data-mission": name }, cells);
  const element = h("div", { class: "entry", role: "none" }, line);
  line.addEventListener("click", (event) => {
    if (!event.target.closest(".opener")) opener.click();
  });
  let more = null;
  let share = null;
  element.show = (row, live) => {
    element.row = row;
    put(number, row.index + 1);
    stands.show(row.status);
    set(line, "data-status", row.status);
    element.tick(live);
    const current = row.trips[row.current];
    const nth = String(row.current + 1); // the name of a trip that was given none
    put(trip, current
      ? `${nth} of ${row.total}: ${current[0] === nth ? plain(current[5]) : current[0]}`
      : `${row.done} of ${row.total} done`);
    if (share !== (share = row.done / row.total)) bar.style.width = `${100 * share}%`;
    put(drone, row.drone ?? "–");
    element.charge(live);
    if (retries) put(cells[4], row.attempt);
    if (rounds) put(cells[retries ? 5 : 4], row.round + 1);
    more?.show(row);
  };
  element.charge = ({ drones }) => charge.show(drones.get(element.row.drone)?.battery ?? null);
  // What changes with the time alone.
  element.tick = ({ state: { time } }) => {
    const { status, reason, wait, until } = element.row;
    const because = reason || (status === "PAUSED" ? "" : wait);
    put(why, `${because}${until > time ? ` (${seconds(until - time)})` : ""}`);
  };
  element.open = (yes) => {
    set(opener, "aria-expanded", String(yes));
    mark(element, yes);
    if (yes === Boolean(more)) return;
    more?.closest("[role=row]").remove();
    more = yes ? details(context, name) : null;
    if (!more) return;
    more.show(element.row);
    element.append(h("div", { role: "row" },
      h("div", { role: "cell", "aria-colspan": String(cells.length) }, more)));
  };
  return element;
}

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
      : live.state.phase !== "idle" ? "The missions are about to begin."
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
