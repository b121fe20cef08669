// Which missions are selected: the one that the panel shows, or several at once.

import { computed, signal } from "@preact/signals";
import { plan, selection, selectKey } from "../core/station.js";

/** @import { Signal } from "@preact/signals" */

/** Those that are selected beside the one of the panel. @type {Signal<readonly string[]>} */
const more = signal([]);

/** Whether a press on a mission adds it to those that are selected, for fingers. */
export const isMarking = signal(false);

/** The keys of all that are selected, in their order. */
export const marked = computed(() => {
  const { key } = selection.value;
  const keys = new Set(key ? [key, ...more.value] : []);
  return plan.missions.value.map((mission) => mission.key).filter((one) => keys.has(one));
});

/** Select one mission, and no others. @param {string | null} key */
export function markOne(key) {
  more.value = [];
  selectKey(key);
}

/** @param {readonly string[]} keys the last one is shown in the panel */
export function markAll(keys) {
  more.value = keys;
  selectKey(keys.at(-1) ?? null);
}

/** Select one more, or one less. @param {string} key */
export function toggle(key) {
  const rest = marked.peek().filter((one) => one !== key);
  if (rest.length === marked.peek().length) markAll([...rest, key]);
  else if (rest.length) markAll(rest);
}

/** Select all from the one of the panel to this one. @param {string} key */
export function extendTo(key) {
  const keys = plan.missions.peek().map((mission) => mission.key);
  const from = keys.indexOf(anchor() ?? key);
  const to = keys.indexOf(key);
  const range = keys.slice(Math.min(from, to), Math.max(from, to) + 1).filter((one) => one !== key);
  markAll(from <= to ? [...range, key] : [...range.reverse(), key]);
}

/** Where the selected range began: its end that is not in the panel. */
function anchor() {
  const { key } = selection.peek();
  const all = marked.peek();
  return all.length < 2 ? key : all[0] === key ? all[all.length - 1] : all[0];
}
