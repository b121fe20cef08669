// Which missions are selected: the one that the panel shows, or several at once.

import { signal } from "@preact/signals";
import { marking } from "../core/marking.js";
import { plan, selection, selectKey } from "../core/station.js";

/** Whether a press on a mission adds it to those that are selected, for fingers. */
export const isMarking = signal(false);

export const { marked, markOne, markAll, toggle, extendTo } = marking(
  () => plan.missions.value.map(({ key }) => key), () => selection.value.key, (key) => selectKey(key));
