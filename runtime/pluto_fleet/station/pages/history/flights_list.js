// The flights of the past: when, by whom, how they ended, and what came of them.

import { h } from "preact";
import { duration } from "../core/format.js";
import { t } from "../core/i18n.js";
import { go } from "../core/route.js";
import { Icon } from "../ui/icon.js";
import { Chip, Empty } from "../ui/parts.js";
import { beginWords, ENDS, outcomeWords } from "./words.js";

const COLUMNS = /** @type {const} */ (["begun", "end", "missions", "trips", "results", "duration", "by"]);

/** @param {{ flights: FlightSummary[] }} props */
export function FlightsList({ flights }) {
  if (!flights.length) return h(Empty, null, t("history.none"));
  return h("table", { class: "table flights", "aria-label": t("history.flights") },
    h("thead", null, h("tr", null, COLUMNS.map((column) => h("th", { key: column, scope: "col" }, t(`history.column.${column}`))))),
    h("tbody", null, flights.map((flight) => h(Flight, { key: flight.id, flight }))));
}

/** @param {{ flight: FlightSummary }} props */
function Flight({ flight }) {
  const { id, end, trips, results, seconds, by, simulated, failed, lost, said } = flight;
  const [kind, icon] = ENDS[end];
  return h("tr", { class: "flight" },
    h("td", null, h("button", { type: "button", class: "link flight-name", onClick: () => go("history", id) }, beginWords(flight)),
      simulated && h(Chip, null, t("simulated")),
      said && h("p", { class: "problem" }, h(Icon, { name: "warning" }), said)),
    h("td", { "data-label": t("history.column.end") }, h(Chip, { kind, icon }, t(`history.end.${end}`))),
    h("td", { "data-label": t("history.column.missions"), class: failed ? "failed" : "" }, outcomeWords(flight),
      lost.length > 0 && h("p", { class: "problem" }, h(Icon, { name: "warning" }), t("history.lost", { drones: lost }))),
    h("td", { class: "num", "data-label": t("history.column.trips") }, trips),
    h("td", { class: "num", "data-label": t("history.column.results") }, results),
    h("td", { class: "num", "data-label": t("history.column.duration") }, duration(seconds)),
    h("td", { class: "called", "data-label": t("history.column.by") }, by ?? t("history.by-unknown")));
}
