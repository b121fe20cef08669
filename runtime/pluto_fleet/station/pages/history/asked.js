// What a page asks of the station when it opens, what stands there until it has come, and how flights are called.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { get, StationError } from "../core/api.js";
import { duration, moment, t } from "../core/i18n.js";
import { Icon } from "../ui/parts.js";

/** @import { IconName } from "../ui/parts.js" */

/** @template Data @typedef {{ data: Data | null, trouble: string }} Asked */

/**
 * What the station says at an address; asked again when that changes, or when `anew` does.
 * @template Data
 * @param {string | null} path null: nothing is asked
 * @param {unknown} [anew]
 * @returns {Asked<Data>}
 */
export function useAsked(path, anew) {
  const [asked, setAsked] = useState(/** @type {Asked<Data> & { path: string | null }} */ ({ data: null, trouble: "", path: null }));
  useEffect(() => {
    let isWanted = true;
    const keep = (/** @type {Asked<Data>} */ answer) => { if (isWanted) setAsked({ ...answer, path }); };
    if (path !== null) {
      get(path, 30000).then((data) => keep({ data, trouble: "" }), (error) => {
        if (!(error instanceof StationError)) throw error;
        keep({ data: null, trouble: error.message });
      });
    }
    return () => { isWanted = false; };
  }, [path, anew]);
  return asked.path === path ? asked : { data: null, trouble: "" };
}

/** What stands where something is still on its way, or could not be had. @param {{ trouble: string }} props */
export const Waiting = ({ trouble }) => (trouble
  ? h("p", { class: "problem replay-trouble", role: "alert" }, h(Icon, { name: "warning" }), trouble)
  : h("p", { class: "muted replay-trouble", role: "status" }, t("history.loading")));

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
