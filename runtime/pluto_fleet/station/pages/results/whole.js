// All results of the flight as it is now: live messages bring only the newest to a page that came late.

import { effect } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get, StationError } from "../core/api.js";

/** @import { World } from "../core/world.js" */

const PATIENCE = 30000; // ms

/** Fetch what a world has missed. @param {World} world */
export function useWhole(world) {
  useEffect(() => {
    let asked = ""; // the flight and its last result when it was asked for: else a loss would be asked for for ever
    return effect(() => {
      const { results, flight } = world;
      const now = `${flight.value} ${results.last}`;
      if (results.isWhole || now === asked) return;
      asked = now;
      get("/api/results.json", PATIENCE).then((all) => {
        if (now.startsWith(`${flight.peek()} `)) results.fill(all);
      }, (error) => {
        if (!(error instanceof StationError)) throw error; // the next result asks again
      });
    });
  }, [world]);
}
