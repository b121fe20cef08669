// One mission in the table, and what opens below it: its trips, and what one can do with them.

import { h, keyed, plain, put, seconds, set, shown } from "./dom.js";
import { battery, ended, mark, round, standing } from "./standing.js";

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
  const element = h("li", null, nth, h("span", { class: "called" }, name, what), stands, weighs, skip);
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
  const [number, why, trip, drone] = ["token", "why", "", ""].map((kind) => h("span", { class: kind }));
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
    if (share !== row.done / row.total) bar.style.width = `${100 * (share = row.done / row.total)}%`;
    put(drone, row.drone ?? "–");
    element.charge(live);
    if (retries) put(cells[4], row.attempt);
    if (rounds) put(cells[retries ? 5 : 4], row.round + 1);
    more?.show(row);
  };
  element.charge = ({ drones }) => charge.show(drones.get(element.row.drone)?.battery ?? null);
  // What changes with the time alone.
  element.tick = ({ state: { time } }) => {
    const { reason, wait, until } = element.row;
    put(why, `${reason || wait}${until > time ? ` (${seconds(until - time)})` : ""}`);
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
