// One flight of the past: its replay, its results, its report, and its files.

import { useSignal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { t } from "../core/i18n.js";
import { go } from "../core/route.js";
import { save } from "../core/station.js";
import { World } from "../core/world.js";
import { ResultsView } from "../results/page.js";
import { Button, Tabs } from "../ui/parts.js";
import { useAsked, Waiting } from "./asked.js";
import { ReplayView } from "./replay_view.js";
import { ReportView } from "./report_view.js";

const TABS = /** @type {const} */ (["replay", "results", "report"]);
/** @typedef {typeof TABS[number]} TabName */

/** @param {{ flight: string }} props */
export function FlightView({ flight }) {
  const tab = useSignal(/** @type {TabName} */ ("replay"));
  const from = useSignal(0);
  const now = useSignal(0); // where the replay was left
  const isRehearsal = flight.startsWith("rehearsal-");
  const query = `?flight=${encodeURIComponent(flight)}`;
  return h("div", { class: "flight-view" },
    h("div", { class: "flight-bar row no-print", "data-tab": tab.value },
      h(Button, { kind: "quiet", icon: "back", onClick: () => go("history") }, t("history.all-flights")),
      !isRehearsal && h(Tabs, {
        label: t("history.of-flight"), names: TABS, now: tab.value, title: (/** @type {TabName} */ name) => t(`history.tab.${name}`),
        onPick: (/** @type {TabName} */ name) => {
          from.value = now.value;
          tab.value = name;
        },
      }),
      !isRehearsal && h("div", { class: "row spread", role: "group", "aria-label": t("results.export") },
        h(Button, { small: true, kind: "quiet", icon: "save", onClick: () => { save(`/api/flights/mcap${query}`, `${flight}.mcap`); } }, t("history.mcap")),
        h(Button, { small: true, kind: "quiet", icon: "save", onClick: () => { save(`/api/console.txt${query}`, `${flight}.txt`); } }, t("monitor.log")))),
    h("div", { class: "flight-body", "data-tab": tab.value }, {
      replay: () => h(ReplayView, { flight, from: from.value, onTime: (time) => { now.value = time; } }),
      results: () => h(PastResults, {
        flight, onReplay: (time) => {
          from.value = time;
          tab.value = "replay";
        },
      }),
      report: () => h(ReportView, { flight }),
    }[isRehearsal ? "replay" : tab.value]()));
}

/** @param {{ flight: string, onReplay: (time: number) => void }} props */
export function PastResults({ flight, onReplay }) {
  const { data, trouble } = /** @type {Answer<Result[]>} */ (useAsked(`/api/results.json?flight=${encodeURIComponent(flight)}`));
  const world = useMemo(() => new World(), [flight]);
  useEffect(() => {
    if (!data) return;
    world.results.replace(data);
    world.state.value = { ...world.state.peek(), phase: "over", known: true };
  }, [data, world]);
  if (!data) return h(Waiting, { trouble });
  return h(ResultsView, {
    world, flight, onConsole: ({ time }) => onReplay(time), consoleWords: t("history.show-in-replay"),
  });
}
