// One mission in the table: its cells, which write only what changed, and what opens below them.
import { h } from "./dom.js";
import { battery } from "./battery.js";
import { details } from "./details.js";
import { attribute, visible, words } from "./quick.js";
import { sign, tone } from "./signs.js";
import { missionWord } from "./standing.js";
import { seconds } from "./dom.js";

export function missionRow(context, app, name, chosen) {
  const [state, why, left, trip, drone, attempt, round] = Array.from({ length: 7 }, () => words());
  const number = words();
  const mark = sign();
  const charge = battery();
  const fill = h("span", { class: "part-done" });
  const opener = h(
    "button",
    { type: "button", class: "opener", "aria-expanded": "false" },
    h("span", { class: "arrow", "aria-hidden": "true" }),
    h("span", { class: "m-token", "aria-hidden": "true" }, number.node),
    h("span", { class: "called" }, name),
  );
  const cell = (kind, ...inside) => h("div", { class: `m-cell c-${kind}`, role: "cell" }, ...inside);
  const whyLine = h("div", { class: "m-why" }, why.node, left.node);
  const statusWord = h("span", { class: "m-status" }, mark.element, state.node);
  const cells = [
    cell("name", opener),
    cell("state", statusWord, whyLine),
    cell("trip", trip.node, h("span", { class: "track", "aria-hidden": "true" }, fill)),
    cell("drone", drone.node, " ", charge.element),
  ];
  if (app.retries) cells.push(cell("attempt", attempt.node));
  if (app.rounds) cells.push(cell("round", round.node));
  const line = h("div", { class: "mission-row", role: "row", "data-mission": name }, ...cells);
  const element = h("div", { class: "entry", role: "none" }, line);
  line.addEventListener("click", (event) => {
    if (!event.target.closest(".opener")) opener.click();
  });
  opener.addEventListener("click", () => chosen.set(chosen.get() === name ? null : name));

  const write = {
    status: attribute(line, "data-status"),
    tone: attribute(statusWord, "data-tone"),
    why: visible(whyLine),
    title: attribute(whyLine, "title"),
    attempt: attribute(line, "data-again"),
  };
  let row = null;
  let more = null;
  let progress = null;

  const show = (next, time, batteryOf) => {
    row = next;
    number.show(String(row.index + 1));
    mark.show(row.status);
    write.status(row.status);
    write.tone(tone(row.status));
    state.show(missionWord(row.status));
    why.show(row.reason || row.wait || "");
    write.title(row.reason || row.wait || null);
    trip.show(whereItIs(row));
    const share = row.total ? row.done / row.total : 0;
    if (share !== progress) {
      progress = share;
      fill.style.width = `${share * 100}%`;
    }
    drone.show(row.drone ?? "–");
    charge.show(row.drone === null ? null : batteryOf(row.drone));
    attempt.show(String(row.attempt));
    write.attempt(row.attempt > 1 ? "yes" : null);
    round.show(String(row.round + 1));
    tick(time);
    more?.show(row);
  };
  // What changes with the time alone.
  const tick = (time) => {
    const waits = row.until !== null && row.until > time;
    left.show(waits ? ` (${seconds(row.until - time)} left)` : "");
    write.why(Boolean(row.reason || row.wait || waits));
  };
  const open = (opened) => {
    opener.setAttribute("aria-expanded", String(opened));
    element.classList.toggle("open", opened);
    more?.element.remove();
    more = null;
    if (!opened) return;
    more = details(context, app, name);
    if (row) more.show(row);
    const inside = h("div", { role: "cell", "aria-colspan": String(cells.length) }, more.element);
    more.element = h("div", { class: "m-more", role: "row" }, inside);
    element.append(more.element);
  };
  return {
    name,
    element,
    opener,
    show,
    tick,
    open,
    get data() {
      return row;
    },
    battery: (id, value) => row?.drone === id && charge.show(value),
  };
}

function whereItIs(row) {
  if (!row.total) return "No trips";
  const current = row.current === null ? null : row.trips[row.current];
  if (!current) return `${row.done} of ${row.total} done`;
  return `${row.current + 1} of ${row.total}: ${current[0]}`;
}

