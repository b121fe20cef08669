// The forecast of a Start: asked of the station, anew whenever the plan has changed.

import { signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { send, StationError } from "../core/api.js";
import { plan } from "../core/station.js";

/** @typedef {{ forecast: Forecast | null, trouble: string }} Asked */

const LONGEST = 30000; // ms
const SETTLES = 400; // ms until a plan that is being changed is asked about

/**
 * What is expected of a Start; null until it is known.
 * @param {string[] | null} missions @param {boolean} onlyFailed
 */
export function useForecast(missions, onlyFailed) {
  const asked = useMemo(() => signal(/** @type {Asked} */ ({ forecast: null, trouble: "" })), []);
  const drawn = plan.missions.value;
  useEffect(() => {
    let isOld = false;
    asked.value = { forecast: null, trouble: "" };
    const timer = setTimeout(async () => {
      try {
        if (!await plan.saved()) return;
        const content = { revision: plan.revision, missions, only_failed: onlyFailed };
        const { status, data } = await send("POST", "/api/preflight", content, { timeout: LONGEST });
        if (!isOld) asked.value = status === 200 ? { forecast: data, trouble: "" } : { forecast: null, trouble: data.said };
      } catch (error) {
        if (!(error instanceof StationError)) throw error;
        if (!isOld) asked.value = { forecast: null, trouble: error.message };
      }
    }, SETTLES);
    return () => {
      isOld = true;
      clearTimeout(timer);
    };
  }, [drawn, missions, onlyFailed, asked]);
  return asked.value;
}
