// The page Results: what the present flight has brought, or the last one.

import { effect } from "@preact/signals";
import { h } from "preact";
import { useEffect } from "preact/hooks";
import { get, ofStation } from "../core/api.js";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { go } from "../core/route.js";
import { selectMission, world } from "../core/station.js";
import { ResultsView } from "./view.js";

const PATIENCE = 30000; // ms

/** @param {Result} result */
function showInConsole({ mission }) {
  selectMission(mission);
  prefs.railTab.value = "log";
  prefs.rail.value = true;
  go("monitor");
}

/** All results of the flight as it is now: live messages bring only the newest to a page that came late. */
function useWhole() {
  useEffect(() => {
    let asked = ""; // the flight and its last result when it was asked for: else a loss would be asked for for ever
    return effect(() => {
      const { results, flight } = world;
      const now = `${flight.value} ${results.last}`;
      if (results.isWhole || now === asked) return;
      asked = now;
      get("/api/results.json", PATIENCE).then((all) => {
        if (now.startsWith(`${flight.peek()} `)) results.fill(all);
      }, ofStation); // the next result asks again
    });
  }, []);
}

export default function Results() {
  useWhole();
  return h(ResultsView, { world, flight: null, onConsole: showInConsole, consoleWords: t("results.show-in-console") });
}
