// The page History: the flights that are kept here, each to be watched again; and what drones have flown.

import { useSignal } from "@preact/signals";
import { h } from "preact";
import { t } from "../core/i18n.js";
import { part } from "../core/route.js";
import { world } from "../core/station.js";
import { Tabs } from "../ui/parts.js";
import { useAsked, Waiting } from "./asked.js";
import { FlightView } from "./flight_view.js";
import { FlightsList } from "./flights_list.js";
import { Hours } from "./hours.js";

/** @import { Asked } from "./asked.js" */

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
  const { data, trouble } = /** @type {Asked<FlightSummary[]>} */ (useAsked("/api/flights", phase));
  return data ? h(FlightsList, { flights: data }) : h(Waiting, { trouble });
}

function Drones() {
  const { data, trouble } = /** @type {Asked<DroneHours[]>} */ (useAsked("/api/drones/hours"));
  return data ? h(Hours, { drones: data }) : h(Waiting, { trouble });
}
