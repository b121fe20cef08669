// What an opened mission shows: its trips, and what one can do with each and with all.
import { h } from "./dom.js";
import { question } from "./questions.js";
import { inOrder } from "./quick.js";
import { sureButton } from "./sure.js";
import { tripLine } from "./trip_line.js";
import { hasEnded } from "./standing.js";

export function details(context, app, mission) {
  const send = (name, given = {}) => context.tell(name, { mission, ...given });
  const pause = h("button", { type: "button", class: "button quiet small" });
  let paused = false;
  pause.addEventListener("click", () => send(paused ? "go-on" : "pause"));
  const cancel = sureButton("Cancel mission", "Really cancel? It ends for good", () =>
    send("cancel"),
  );
  const asked = h("div", { class: "asked" });
  const reason = h("p", { class: "reason" });
  const list = h("ol", { class: "m-lines" });
  const buttons = h("div", { class: "buttons" }, pause, cancel);
  const element = h("div", { class: "details" }, asked, reason, list, buttons);
  const lines = new Map();
  const priorities = app.fields.trip.some((field) => field.name === "priority");

  let shownTrips = null;
  let shownQuestion = null;
  const show = (row) => {
    const ended = hasEnded(row);
    paused = row.status === "PAUSED";
    pause.textContent = paused ? "Go on" : "Pause";
    buttons.hidden = ended;
    pause.hidden = Boolean(row.question);
    reason.textContent = row.reason || row.wait || "";
    reason.hidden = !reason.textContent || Boolean(row.question);
    const asks = JSON.stringify(row.question);
    if (asks !== shownQuestion) {
      shownQuestion = asks;
      asked.replaceChildren(...(row.question ? [question(context, row)] : []));
    }
    const trips = JSON.stringify([row.trips, row.current, ended]);
    if (trips !== shownTrips) {
      shownTrips = trips;
      showTrips(row, ended);
    }
  };
  // A line belongs to its trip, not to its place: what one is about to press never moves away.
  const showTrips = (row, ended) => {
    const seen = new Map();
    const order = row.trips.map((trip, index) => {
      const nth = (seen.get(trip[0]) ?? 0) + 1;
      seen.set(trip[0], nth);
      const key = `${nth} ${trip[0]}`;
      const line = lines.get(key) ?? tripLine(trip[0], send, priorities);
      lines.set(key, line);
      line.show(trip, { index, current: index === row.current && !ended, ended });
      return line;
    });
    const kept = new Set(order);
    for (const [key, line] of lines) {
      if (kept.has(line)) continue;
      line.element.remove();
      lines.delete(key);
    }
    inOrder(list, order.map((line) => line.element));
  };
  return { element, show };
}
