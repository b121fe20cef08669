// The page Results: what the present flight has brought, or the last one.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { go } from "../core/route.js";
import { selectMission, world } from "../core/station.js";
import { ResultsView } from "./view.js";
import { useWhole } from "./whole.js";

/** @import { Result } from "../wire" */

/** @param {Result} result */
function showInConsole({ mission }) {
  selectMission(mission);
  prefs.railTab.value = "log";
  prefs.rail.value = true;
  go("monitor");
}

export default function Results() {
  useWhole(world);
  return h(ResultsView, { world, flight: null, onConsole: showInConsole, consoleWords: t("results.show-in-console") });
}
