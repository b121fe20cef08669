// The page History: the flights that are kept here, when, by whom, how they ended and what came of them, each to
// be watched again; and what drones have flown over all of them.

import { useSignal } from "@preact/signals";
import { h } from "preact";
import { duration, moment, number, t } from "../core/i18n.js";
import { go, part } from "../core/route.js";
import { world } from "../core/station.js";
import { Chip, Empty, Problem, Tabs } from "../ui/parts.js";
import { ENDS, outcomeWords, useAsked, Waiting } from "./asked.js";
import { FlightView } from "./flight_view.js";

const TABS = /** @type {const} */ (["flights", "hours"]);
/** @typedef {typeof TABS[number]} TabName */

export default function History() {
  const tab = useSignal(/** @type {TabName} */ ("flights"));
  if (part.value) return h(FlightView, { key: part.value, flight: part.value });
  return h("div", { class: "history-lists stack" },
    h(Tabs, {
      label: t("history.lists"), names: TABS, now: tab.value, title: (/** @type {TabName} */ name) => t(`history.${name}`),
      onPick: (/** @type {TabName} */ name) => { tab.value = name; },
    }),
    h("div", { role: "tabpanel", "aria-label": t(`history.${tab.value}`) }, tab.value === "flights" ? h(Flights, null) : h(Drones, null)));
}

function Flights() {
  const { phase } = world.state.value; // a flight that began or ended is another line
  const { data, trouble } = /** @type {Answer<FlightSummary[]>} */ (useAsked("/api/flights", phase));
  return data ? h(FlightsList, { flights: data }) : h(Waiting, { trouble });
}

function Drones() {
  const { data, trouble } = /** @type {Answer<DroneHours[]>} */ (useAsked("/api/drones/hours"));
  return data ? h(Hours, { drones: data }) : h(Waiting, { trouble });
}

const COLUMNS = /** @type {const} */ (["begun", "end", "missions", "trips", "results", "duration", "by"]);

/** @param {{ flights: FlightSummary[] }} props */
export function FlightsList({ flights }) {
  if (!flights.length) return h(Empty, null, t("history.none"));
  return h("table", { class: "table flights", "aria-label": t("history.flights") },
    h("thead", null, h("tr", null, COLUMNS.map((column) => h("th", { key: column, scope: "col" }, t(`column.${column}`))))),
    h("tbody", null, flights.map((flight) => h(Flight, { key: flight.id, flight }))));
}

/** @param {{ flight: FlightSummary }} props */
function Flight({ flight }) {
  const { id, begun_at: begun, end, trips, results, seconds, by, simulated, failed, lost, said } = flight;
  const [kind, icon] = ENDS[end];
  return h("tr", { class: "flight" },
    h("td", null, h("button", { type: "button", class: "link flight-name", onClick: () => go("history", id) }, begun === null ? id : moment(begun)),
      simulated && h(Chip, null, t("simulated.at")),
      said && h(Problem, { text: said })),
    h("td", { "data-label": t("column.end") }, h(Chip, { kind, icon }, t(`history.end.${end}`))),
    h("td", { "data-label": t("column.missions"), class: failed ? "failed" : "" }, outcomeWords(flight),
      lost.length > 0 && h(Problem, { text: t("history.lost", { drones: lost }), isOwn: true })),
    h("td", { class: "num", "data-label": t("column.trips") }, trips),
    h("td", { class: "num", "data-label": t("column.results") }, results),
    h("td", { class: "num", "data-label": t("column.duration") }, duration(seconds)),
    h("td", { class: "called", "data-label": t("column.by") }, by ?? t("unknown")));
}

const HOURS = /** @type {const} */ (["drone", "flights", "trips", "hours", "cycles", "lost"]);
const one = { minimumFractionDigits: 1, maximumFractionDigits: 1 };

/** @param {{ drones: DroneHours[] }} props */
export function Hours({ drones }) {
  if (!drones.length) return h(Empty, null, t("history.no-hours"));
  const unmeasured = drones.some((drone) => drone.unmeasured > 0);
  return h("div", { class: "stack" },
    h("table", { class: "table hours", "aria-label": t("history.hours") },
      h("thead", null, h("tr", null, HOURS.map((column) => h("th", { key: column, scope: "col" }, t(`column.${column}`))))),
      h("tbody", null, drones.map((drone) => h("tr", { key: drone.id },
        h("th", { scope: "row", class: "called" }, drone.id), h("td", { class: "num" }, drone.flights), h("td", { class: "num" }, drone.trips),
        h("td", { class: "num" }, number(drone.hours, one), drone.unmeasured > 0 && h("span", { class: "muted" }, " +")),
        h("td", { class: "num" }, number(drone.cycles, one), drone.unmeasured > 0 && h("span", { class: "muted" }, " +")),
        h("td", { class: "num" }, drone.lost))))),
    h("p", { class: "hint" }, t("history.cycles-hint"), unmeasured && ` ${t("history.unmeasured-hint")}`));
}
