// How flights and their parts are called.

import { duration, moment } from "../core/format.js";
import { t } from "../core/i18n.js";

/** @import { IconName } from "../ui/icon.js" */

/** @type {Record<FlightSummary["end"], ["" | "good" | "warn" | "bad" | "info", IconName]>} */
export const ENDS = {
  flying: ["good", "start"], stopped: ["warn", "pause"], interrupted: ["warn", "warning"], over: ["info", "good"],
  unknown: ["warn", "warning"],
};

/** @param {FlightSummary} flight */
export const beginWords = ({ begun_at: at, id }) => (at === null ? id : moment(at));

/** "5 completed, 1 failed": only what there is. @param {FlightSummary} flight */
export function outcomeWords({ missions, completed, failed, cancelled }) {
  const open = missions - completed - failed - cancelled;
  return [
    completed > 0 && t("history.completed", { n: completed }), failed > 0 && t("history.failed", { n: failed }),
    cancelled > 0 && t("history.cancelled", { n: cancelled }), open > 0 && t("history.open", { n: open }),
  ].filter(Boolean).join(", ") || t("history.no-missions");
}

/** @param {number | null} from @param {number | null} to seconds */
export const tookWords = (from, to) => (from === null || to === null ? "" : duration(to - from));
