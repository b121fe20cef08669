// What a page asks of the station when it opens, what stands there until it has come, and how flights are called.

import { h } from "preact";
import { get } from "../core/api.js";
import { t } from "../core/i18n.js";
import { useAnswer } from "../ui/hooks.js";
import { Problem } from "../ui/parts.js";

/** What the station says at an address; asked again when `anew` changes. @param {string} path @param {unknown} [anew] */
export const useAsked = (path, anew) => useAnswer([path], () => get(path, 30000), { anew });

/** What stands where something is still on its way, or could not be had. @param {{ trouble: string }} props */
export const Waiting = ({ trouble }) => (trouble
  ? h(Problem, { class: "problem replay-trouble", role: "alert", text: trouble })
  : h("p", { class: "muted replay-trouble", role: "status" }, t("loading")));

/** @type {Record<FlightSummary["end"], ["" | "good" | "warn" | "bad" | "info", IconName]>} */
export const ENDS = {
  flying: ["good", "start"], stopped: ["warn", "pause"], interrupted: ["warn", "warning"], over: ["info", "good"],
  unknown: ["warn", "warning"],
};

/** "5 completed, 1 failed": only what there is. @param {FlightSummary} flight */
export function outcomeWords({ missions, completed, failed, cancelled }) {
  const open = missions - completed - failed - cancelled;
  return [
    completed > 0 && t("history.completed", { n: completed }), failed > 0 && t("history.failed", { n: failed }),
    cancelled > 0 && t("history.cancelled", { n: cancelled }), open > 0 && t("history.open", { n: open }),
  ].filter(Boolean).join(", ") || t("history.no-missions");
}
