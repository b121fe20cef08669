// How missions, trips and drones stand; one mission in the table, and what opens below it.

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
export const needsYou = ({ status }) => status === "UNCERTAIN" || status === "HELD";
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
function sureButton(label, act) {
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
  const [nth, what, weight] = [h("span", { class: "nth" }), h("small"), h("output")];
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
  const element = h("li", null, nth, h("span", { class: "called" }, name, what), stands, weighs,
    skip);
  element.show = ({ trip: [, status, x, y, number, action], index, current, over }) => {
    priority = number ?? 1;
    put(nth, `${index + 1}.`);
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

export function missionRow(context, name, chosen) {
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
    put(trip, current ? `${row.current + 1} of ${row.total}: ${current[0]}`
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
