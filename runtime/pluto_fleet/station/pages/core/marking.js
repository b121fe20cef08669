// Several things selected at once: the one that is shown, and others beside it.

import { computed, signal } from "@preact/signals";

/**
 * @param {() => readonly string[]} keys of all there are, in their order
 * @param {() => string | null} shown the one that is shown
 * @param {(key: string | null) => void} show
 */
export function marking(keys, shown, show) {
  /** Those that are selected beside the one that is shown. @type {Signal<readonly string[]>} */
  const more = signal([]);

  /** The keys of all that are selected, in their order. @type {ReadonlySignal<readonly string[]>} */
  const marked = computed(() => {
    const key = shown();
    const all = new Set(key ? [key, ...more.value] : []);
    return keys().filter((one) => all.has(one));
  });

  /** Select one, and no others. @param {string | null} key */
  function markOne(key) {
    more.value = [];
    show(key);
  }

  /** @param {readonly string[]} all the last one is shown */
  function markAll(all) {
    more.value = all;
    show(all.at(-1) ?? null);
  }

  /** Select one more, or one less. @param {string} key */
  function toggle(key) {
    const rest = marked.peek().filter((one) => one !== key);
    markAll(rest.length === marked.peek().length ? [...rest, key] : rest);
  }

  /** Select all from where the selection began to this one. @param {string} key */
  function extendTo(key) {
    const [all, now] = [keys(), marked.peek()];
    const other = now[0] === shown() ? now.at(-1) : now[0]; // the end that is not shown
    const [from, to] = [all.indexOf(other ?? key), all.indexOf(key)];
    const range = all.slice(Math.min(from, to), Math.max(from, to) + 1).filter((one) => one !== key);
    markAll([...range, key]);
  }
  return { marked, markOne, markAll, toggle, extendTo };
}
