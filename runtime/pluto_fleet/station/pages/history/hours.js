// What each drone has flown, over all flights that are kept here.

import { h } from "preact";
import { number } from "../core/format.js";
import { t } from "../core/i18n.js";
import { Empty } from "../ui/parts.js";

const COLUMNS = /** @type {const} */ (["drone", "flights", "trips", "hours", "cycles", "lost"]);
const one = { minimumFractionDigits: 1, maximumFractionDigits: 1 };

/** @param {{ drones: DroneHours[] }} props */
export function Hours({ drones }) {
  if (!drones.length) return h(Empty, null, t("history.no-hours"));
  const unmeasured = drones.some((drone) => drone.unmeasured > 0);
  return h("div", { class: "stack" },
    h("table", { class: "table hours", "aria-label": t("history.hours") },
      h("thead", null, h("tr", null, COLUMNS.map((column) => h("th", { key: column, scope: "col" }, t(`history.hours.${column}`))))),
      h("tbody", null, drones.map((drone) => h("tr", { key: drone.id },
        h("th", { scope: "row", class: "called" }, drone.id), h("td", { class: "num" }, drone.flights), h("td", { class: "num" }, drone.trips),
        h("td", { class: "num" }, number(drone.hours, one), drone.unmeasured > 0 && h("span", { class: "muted" }, " +")),
        h("td", { class: "num" }, number(drone.cycles, one), drone.unmeasured > 0 && h("span", { class: "muted" }, " +")),
        h("td", { class: "num" }, drone.lost))))),
    h("p", { class: "hint" }, t("history.cycles-hint"), unmeasured && ` ${t("history.unmeasured-hint")}`));
}
