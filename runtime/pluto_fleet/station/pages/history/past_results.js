// The results of a flight of the past, as the page Results shows those of now.

import { h } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { t } from "../core/i18n.js";
import { World } from "../core/world.js";
import { ResultsView } from "../results/view.js";
import { useAsked, Waiting } from "./asked.js";

/** @param {{ flight: string, onReplay: (time: number) => void }} props */
export function PastResults({ flight, onReplay }) {
  const { data, trouble } = /** @type {import("./asked.js").Asked<Result[]>} */ (
    useAsked(`/api/results.json?flight=${encodeURIComponent(flight)}`));
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
