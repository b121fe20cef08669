// What this browser remembers: kept in local storage, and told to its other tabs.

import { effect, signal } from "@preact/signals";

/** @type {Map<string, Signal<any>>} */
const kept = new Map();
const stored = (/** @type {string} */ name) => `pluto-${name}`;

/** A value that this browser remembers. @template Value @param {string} name @param {Value} usual @returns {Signal<Value>} */
function remembered(name, usual) {
  const value = signal(usual);
  try {
    value.value = JSON.parse(localStorage.getItem(stored(name)) ?? "");
  } catch {
    // nothing is kept, or another program has written it
  }
  kept.set(stored(name), value);
  effect(() => localStorage.setItem(stored(name), JSON.stringify(value.value)));
  return value;
}

window.addEventListener("storage", ({ key, newValue }) => {
  const value = key === null ? undefined : kept.get(key);
  if (value && newValue !== null) value.value = JSON.parse(newValue);
});

export const prefs = {
  /** `auto` is what the system says. */
  theme: remembered("theme", /** @type {"auto" | "light" | "dark"} */ ("auto")),
  contrast: remembered("contrast", /** @type {"auto" | "more"} */ ("auto")),
  /** Empty: the browser's. */
  language: remembered("language", ""),
  /** The name of who sits here, for the others and for the records. */
  name: remembered("name", ""),
  sound: remembered("sound", false),
  notify: remembered("notify", false),
  /** Whether the graph is shown on the Monitor: developers want it, users do not. */
  graph: remembered("graph", false),
  rail: remembered("rail", true),
  railTab: remembered("rail-tab", "missions"),
  tour: remembered("tour-seen", false),
  /** Which layers of the results are on, and how opaque, by their ids; the others are as is usual. */
  layers: remembered("layers", /** @type {Record<string, boolean>} */ ({})),
  opacity: remembered("opacity", /** @type {Record<string, number>} */ ({})),
  resultsTab: remembered("results-tab", "layers"),
};

const dark = matchMedia("(prefers-color-scheme: dark)");
const more = matchMedia("(prefers-contrast: more)");

/** Let the page look as its reader wants, also when the system changes. */
export function applyLook() {
  const apply = () => {
    const { dataset } = document.documentElement;
    dataset.theme = prefs.theme.value === "auto" ? (dark.matches ? "dark" : "light") : prefs.theme.value;
    dataset.contrast = prefs.contrast.value === "more" || more.matches ? "more" : "usual";
  };
  effect(apply);
  dark.addEventListener("change", apply);
  more.addEventListener("change", apply);
}
