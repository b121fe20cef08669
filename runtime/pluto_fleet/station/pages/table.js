// The lists of the Monitor: missions, what happens, and what it brought.

import {
  clock, fill, h, icon, inWords, keyed, many, plain, put, seconds, set, shown, since,
  svg,
} from "./dom.js";
import { mapPicture } from "./floor.js";

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
  LOW: ["Battery low", "wait", "calm"],
  BUSY: ["Flying", "start", "busy"],
  RETURNING: ["Coming home", "home", "busy"],
  CHARGING: ["Charging", "wait", "calm"],
  RECOVERING: ["Recovering", "wait", "warn"],
  LOST: ["Lost", "warning", "bad"],
  OFFLINE: ["Not connected", "info", "calm"],
  LANDED: ["On the ground", "info", "calm"],
  ALOFT: ["In the air", "warning", "warn"],
  UNKNOWN: ["Unknown", "warning", "warn"],
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

export const mark = (element, yes) => set(element, "data-chosen", yes && "yes");

// For what cannot be undone: the first press asks in place, the second one does it; a double click
// and a key that repeats are one press.
export function sureButton(label, act) {
  const button = h("button", { class: "button quiet small" }, label);
  const ask = (yes) => {
    set(button, "data-sure", yes);
    put(button, yes ? `Really ${label.toLowerCase()}?` : label);
  };
  button.addEventListener("blur", () => ask(false));
  button.addEventListener("keydown", (event) => event.repeat && event.preventDefault());
  button.addEventListener("click", ({ detail }) => {
    if (detail > 1) return;
    if (button.dataset.sure) act();
    ask(!button.dataset.sure);
  });
  return button;
}

const HOLD = 1000; // ms
const STUCK = 100; // ms that one frame counts at most: while a page is stuck, no hold is seen

// For what drops a drone: done while a pointer or a key is held down on it for a second. A press
// that is shorter opens a field in which a word is typed instead.
export function holdButton(label, word, act) {
  const how = `Hold it down for a second, or press it once and type “${word}”.`;
  const button = h("button", { class: "button quiet small hold", title: how }, label);
  const typed = h("input", { class: "input", "aria-label": `${label}: type “${word}” and press Enter` });
  const form = h("form", {
    hidden: true,
    onsubmit(event) {
      event.preventDefault();
      const right = typed.value.trim().toLowerCase() === word;
      typed.value = "";
      if (!right) return;
      close();
      act();
    },
    onkeydown: ({ key }) => key === "Escape" && close(),
  }, h("p", { class: "hint" }, how), typed);
  function close() {
    typed.value = "";
    if (form.contains(document.activeElement)) button.focus();
    shown(form, false);
  }
  let held = null; // { at: where the pointer is, or null for a key; time: for how long }
  let done = false; // by the press that is about to end
  const end = () => {
    held = null;
    setTimeout(() => { done = false; });
    button.style.removeProperty("--held");
  };
  function begin(at) {
    const mine = held = { at, time: 0 };
    let before = performance.now();
    done = false;
    document.addEventListener("visibilitychange", end, { once: true });
    window.addEventListener("blur", end, { once: true });
    requestAnimationFrame(function frame(now) {
      if (mine !== held) return;
      const { left, right, top, bottom } = button.getBoundingClientRect();
      const [x, y] = held.at ?? [left, top];
      if (left === right || x < left || x > right || y < top || y > bottom) {
        end(); // it has gone from under the finger
        return;
      }
      held.time += Math.min(Math.max(now - before, 0), STUCK);
      before = now;
      button.style.setProperty("--held", Math.min(held.time / HOLD, 1));
      if (held.time < HOLD) {
        requestAnimationFrame(frame);
        return;
      }
      end();
      done = true;
      close();
      act();
    });
  }
  const press = (yes, touched) => {
    if (!yes || done) return;
    shown(form, true);
    if (!touched) typed.focus();
  };
  const on = (kinds, heard) =>
    kinds.split(" ").forEach((kind) => button.addEventListener(kind, heard));
  on("pointerdown", (event) => {
    if (event.button || !event.isPrimary) return;
    button.setPointerCapture(event.pointerId);
    begin([event.clientX, event.clientY]);
  });
  on("pointermove", ({ clientX, clientY }) => { if (held?.at) held.at = [clientX, clientY]; });
  on("pointerup pointercancel lostpointercapture blur", end);
  on("contextmenu", (event) => event.preventDefault()); // a finger that rests asks for one
  on("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault(); // no click
    if (!event.repeat) begin(null);
  });
  on("keyup", () => {
    press(held);
    end();
  });
  // a screen reader and a voice only click
  on("click", ({ detail, pointerType }) => press(detail < 2, pointerType === "touch"));
  return h("span", { class: "sure" }, button, form);
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

// How long until something is due: to the minute, though it be hours.
function left(time) {
  const minutes = Math.floor(time / 60) % 60;
  return time < 3600 || !minutes ? since(time) : `${since(time)} ${minutes} min`;
}

const said = (value, units) =>
  (typeof value === "boolean" ? value ? "yes" : "no" : inWords(value ?? "", units));

function details(context, name) {
  const send = (command, given) => context.tell(command, { mission: name, ...given });
  const prioritised = context.app.fields.trip.some((field) => field.name === "priority");
  let paused = false;
  const pause = h("button", {
    class: "button small", onclick: () => send(paused ? "go-on" : "pause"),
  });
  const buttons = h("div", { class: "row" }, pause,
    sureButton("Cancel mission", () => send("cancel")));
  const drawn = () => context.plan.missions.find((mission) => mission.name === name);
  const again = h("button", {
    class: "button small", onclick: () => context.begun([drawn().key]),
  }, "Start this mission again");
  const list = h("ol", { class: "trip-lines" });
  const own = context.app.fields.mission.filter((field) => field.own);
  const filled = h("p", { class: "filled" });
  const element = h("div", { class: "details" }, filled, list, buttons, h("div", null, again));
  element.show = (row) => {
    const values = own.map((field) =>
      [field.label, said(row.fields[field.name] ?? field.default, field.units)]);
    put(filled, values.filter(([, text]) => text).map(([label, text]) => `${label}: ${text}`).join(" · "));
    shown(filled, filled.textContent);
    const over = ended(row) || context.live.state.phase !== "flying";
    paused = row.status === "PAUSED";
    put(pause, paused ? "Go on" : "Pause");
    shown(pause, !row.question);
    shown(buttons, !over);
    shown(again, context.live.state.phase === "over" && drawn());
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
  const { retries, rounds, fields } = context.app;
  const texts = fields.mission.filter(({ own, type }) => own && type === "text");
  const whose = h("small");
  const span = (kind) => h("span", { class: kind });
  const [number, why, trip, drone, due] = ["token", "why", "", "", "chip due"].map(span);
  const stands = standing();
  const charge = battery();
  const bar = h("i");
  const opener = h("button", {
    class: "opener", "aria-expanded": "false",
    onclick: () => chosen.set(chosen.name === name ? null : name),
  }, h("span", { class: "arrow" }), number, h("span", { class: "called" }, name, whose));
  const cells = [
    [opener], [h("span", { class: "stands" }, stands, due), why], [trip, h("span", { class: "track" }, bar)], [drone, " ", charge],
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
    put(whose, texts.map(({ name: key }) => row.fields[key]).filter(Boolean).join(" · "));
    shown(whose, whose.textContent);
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
    const { status, reason, wait, until, due: at, late } = element.row;
    const because = reason || (status === "PAUSED" ? "" : wait);
    put(why, `${because}${until > time ? ` (${seconds(until - time)})` : ""}`);
    set(due, "class", `chip due ${late ? "bad" : ""}`);
    put(due, late ? "Late" : `due in ${left(Math.max(0, at - time))}`);
    shown(due, late || (at !== null && !ended(element.row)));
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
  // While the focus is in the table, rows do not change places under their hands.
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

// What happens, line by line, and what the missions brought: measurements, photos, verdicts.

const SHOWN = 1000; // lines on the page
const TOGETHER = 50; // lines in a block of the page: those out of sight cost nothing
const KINDS = {
  "": "All lines", info: "News", good: "Good news", bad: "Trouble", hook: "The app's own lines",
};
const SIGNS = { good: "✓", bad: "!", hook: "›" };

const line = ([, time, mission, text, kind]) => h("div", { class: `log-line ${kind}` },
  h("span", { class: "when" }, clock(time)),
  h("span", { class: "what", "aria-hidden": "true" }, SIGNS[kind]),
  mission !== null && h("b", null, mission), h("span", null, text));

export function consoleView(context, save) {
  const { live } = context;
  const option = ([value, label]) => h("option", { value }, label);
  const text = h("input", {
    type: "search", class: "input", placeholder: "Find text", "aria-label": "Find text",
    oninput: rewrite,
  });
  const of = h("select", { class: "input", "aria-label": "Of which mission", onchange: rewrite },
    option(["", "All missions"]));
  const kind = h("select", { class: "input", "aria-label": "Which lines", onchange: rewrite },
    Object.entries(KINDS).map(option));
  const lines = h("div", {
    class: "log", role: "log", "aria-live": "off", "aria-label": "Console", tabIndex: 0,
    onscroll: () => {
      following = lines.scrollTop + lines.clientHeight >= lines.scrollHeight - 8;
      if (following) unread = 0;
      shown(newest, unread);
    },
  });
  const newest = h("button", {
    class: "button small newest", hidden: true, onclick: () => {
      following = true;
      follow();
      lines.focus();
    },
  });
  const missions = new Set();
  let following = true;
  let unread = 0;
  let block = null;

  const fits = ([, , mission, said, sort]) => (!of.value || mission === of.value)
    && (!kind.value || sort === kind.value)
    && `${mission ?? ""} ${said}`.toLowerCase().includes(text.value.toLowerCase());
  function follow() {
    if (following) {
      lines.scrollTop = lines.scrollHeight;
      unread = 0;
    }
    put(newest, `${many(unread, "new line")} below`);
    shown(newest, unread);
  }
  function add(entries) {
    for (const entry of entries) {
      if (!block || block.childElementCount >= TOGETHER) {
        block = h("div", { class: "log-block" });
        lines.append(block);
      }
      block.append(line(entry));
    }
    while (lines.childElementCount > SHOWN / TOGETHER) lines.firstElementChild.remove();
    follow();
  }
  function rewrite() {
    block = null;
    following = true;
    lines.replaceChildren();
    add(live.log.filter(fits).slice(-SHOWN));
  }
  function update(entries) {
    for (const [, , mission] of entries) {
      if (mission === null || missions.has(mission)) continue;
      missions.add(mission);
      of.append(option([mission, mission]));
    }
    const fitting = entries.filter(fits).slice(-SHOWN);
    if (!following) unread += fitting.length;
    add(fitting);
  }
  function clear() {
    missions.clear();
    of.replaceChildren(of.firstElementChild);
    block = null;
    lines.replaceChildren();
  }
  new ResizeObserver(follow).observe(lines);
  return {
    tools: [text, of, kind, save("/api/console.txt")], body: [lines, newest], update, clear,
  };
}

const LINES = 300;
const PHOTOS = 60;
const VALUES = 60; // in a sparkline
const written = (value) => (typeof value === "number" ? Number(value.toPrecision(6)) : value);
const place = ([x, y]) => `${round(x)}, ${round(y)} m`;

const link = (chosen, mission) =>
  h("button", { class: "link", onclick: () => chosen.set(mission) }, mission);

// How a value went, in a few pixels; a ring marks the newest.
function sparkline(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const points = values.map((value, i) => [4 + (i * 80) / (values.length - 1),
    22 - (high > low ? (18 * (value - low)) / (high - low) : 9)]);
  const [cx, cy] = points.at(-1);
  return svg("svg", { class: "spark", width: 88, height: 26, "aria-hidden": "true" },
    svg("polyline", { points: points.join(" ") }), svg("circle", { cx, cy, r: 2.6 }));
}

function measurements(chosen) {
  const body = h("tbody");
  const lines = new Map();
  const make = (quantity, at, mission, trip) => {
    const cells = Array.from({ length: 3 }, () => h("td", { class: "num" }));
    const element = h("tr", null, h("th", { scope: "row" }, quantity), ...cells, h("td", null, at),
      h("td", null, link(chosen, mission), h("small", null, `trip ${trip}`)));
    return { element, cells, mission, values: [] };
  };
  const heads = ["Measured", "Newest", "How it went", "When", "Where", "For"].map((name) =>
    h("th", { scope: "col" }, name));
  const highlight = () => {
    for (const { element, mission } of lines.values()) mark(element, mission === chosen.name);
  };
  chosen.changed.heard(highlight);
  return {
    element: h("table", { class: "table" }, h("thead", null, h("tr", null, heads)), body),
    add(entries) {
      for (const [, time, mission, trip, , , , , value, , at, , quantity, unit]
        of entries.slice(-LINES)) {
        const what = [plain(quantity), place(at), mission, trip];
        const key = JSON.stringify(what);
        if (!lines.has(key)) lines.set(key, make(...what));
        const { element, cells, values } = lines.get(key);
        if (typeof value === "number") values.push(value);
        values.splice(0, values.length - VALUES);
        put(cells[0], `${written(value)} ${unit ?? ""}`);
        if (values.length > 1) cells[1].replaceChildren(sparkline(values));
        put(cells[2], clock(time));
        body.prepend(element);
      }
      while (body.rows.length > LINES) body.lastElementChild.remove();
      highlight();
    },
    clear() {
      lines.clear();
      body.replaceChildren();
    },
  };
}

function ground(map, { position: [x, y], width, height }) {
  const [across, up] = map.size;
  const picture = svg("image", { width: across, height: up, preserveAspectRatio: "none" });
  const lines = Array.from({ length: Math.ceil(Math.max(across, up)) }, (_, i) =>
    `M${i} 0V${up}M0 ${up - i}H${across}`);
  mapPicture(map).then((address) => address && set(picture, "href", address));
  return svg("svg", {
    class: "ground", "aria-hidden": "true",
    viewBox: `${x - width / 2} ${up - y - height / 2} ${width} ${height}`,
  }, svg("rect", { width: across, height: up }), picture, svg("path", { d: lines.join("") }));
}

function photos({ app }, chosen, floor) {
  const list = h("ul", { class: "photos" });
  const layer = floor.layer("photo-frame");
  const frame = ({ position: [x, y], width, height }) => layer.replaceChildren(
    svg("rect", { x: x - width / 2, y: y - height / 2, width, height }));
  const card = ([, time, mission, trip, , , , , photo]) => {
    const [x, y] = photo.position;
    const sees = photo.sees.map(plain).join(", ");
    const sharp = photo.sharpness < 0.4 ? "blurred" : photo.sharpness < 0.7 ? "soft" : "sharp";
    const act = () => frame(photo);
    const away = () => layer.replaceChildren();
    return h("li", null, h("button", {
      class: "photo", "data-sees": Boolean(sees), "data-sharp": sharp,
      onpointerenter: act, onfocus: act, onpointerleave: away, onblur: away,
      onclick: () => {
        chosen.set(mission);
        floor.reveal(x, y);
      },
    }, ground(app.map, photo), h("b", null, sees || "nothing special"),
    h("span", null, `${mission}, ${trip}`),
    h("small", null, `${clock(time)} at ${round(x)}, ${round(y)}, ${sharp}`)));
  };
  return {
    element: list,
    add(entries) {
      list.prepend(...entries.slice(-PHOTOS).map(card).reverse());
      while (list.childElementCount > PHOTOS) list.lastElementChild.remove();
    },
    clear: () => list.replaceChildren(),
  };
}

function told(chosen, words) {
  const list = h("ul", { class: "verdicts" });
  return {
    element: list,
    add(entries) {
      list.prepend(...entries.slice(-LINES).map((entry) => h("li", null,
        h("span", { class: "when" }, clock(entry[1])),
        link(chosen, entry[2]), h("span", null, words(entry)))).reverse());
      while (list.childElementCount > LINES) list.lastElementChild.remove();
    },
    clear: () => list.replaceChildren(),
  };
}

export function resultsView(context, chosen, floor, save) {
  const part = (kind, none, view) => ({ kind, none, ...view });
  const { app } = context;
  const own = app.actions.filter(({ item, name }) =>
    !item && !["measure", "take_photo"].includes(name));
  const given = (action, [name, value]) => {
    const units = own.find((one) => one.name === action)?.parameters
      .find((one) => one.name === name)?.units;
    return ` ${plain(name)} ${inWords(value, units)},`;
  };
  const parts = {
    Measurements: part("measurement", "Nothing has been measured yet.", measurements(chosen)),
    Photos: part("photo", "No photo has been taken yet.", photos(context, chosen, floor)),
  };
  if (own.length) {
    parts["Other actions"] = part("result", "No such action has been done yet.", told(chosen,
      ([, , , trip, , , , , value, action, at, parameters]) => `trip ${trip}: ${plain(action)},${
        Object.entries(parameters).map((one) => given(action, one)).join("")} at ${
        place(at)}; it returned ${written(value)}`));
  }
  if (app.evaluators.length) {
    parts.Verdicts = part("verdict", "No mission has been judged yet.", told(chosen,
      (entry) => entry[8]));
  }
  const all = Object.entries(parts);
  const empty = h("p", { class: "empty" });
  let now = "";
  const show = () => {
    for (const [name, { element, none, number }] of all) {
      shown(element, name === now && number);
      if (name !== now) continue;
      shown(empty, !number);
      put(empty, none);
    }
  };
  let picked = false;
  const tabs = sieve(Object.keys(parts), "Which results", (name) => {
    now = name;
    picked = true;
    show();
  });
  function update(entries) {
    for (const [name, part] of all) {
      const own = entries.filter((entry) => entry[7] === part.kind && entry[8] !== null);
      if (!own.length) continue;
      part.number += own.length;
      tabs.count(name, part.number);
      part.add(own);
      if (!picked && !parts[now].number) tabs.pick(name);
    }
    show();
  }
  function clear() {
    for (const [name, part] of all) {
      part.number = 0;
      tabs.count(name, 0);
      part.clear();
    }
    show();
  }
  clear();
  tabs.pick("Measurements");
  picked = false;
  return {
    tools: [tabs, save("/api/results.json")], body: [empty, all.map(([, part]) => part.element)],
    update, clear,
  };
}
