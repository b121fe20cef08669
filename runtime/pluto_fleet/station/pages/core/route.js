// Which page is open: it stands in the address after #, so that Back goes back.

import { signal } from "@preact/signals";

export const PAGES = /** @type {const} */ (
  ["missions", "trips", "monitor", "results", "history", "map", "help"]);
/** @typedef {typeof PAGES[number]} PageName */

const fromAddress = () => {
  const name = location.hash.slice(1).split("/")[0];
  return PAGES.find((one) => one === name) ?? "missions";
};

export const page = signal(/** @type {PageName} */ (fromAddress()));
/** A field that a page is to go to, when it is shown. */
export const wantedField = signal(/** @type {{ trip: string | null, field: string | null } | null} */ (null));

window.addEventListener("popstate", () => { page.value = fromAddress(); });

/** Open a page. @param {PageName} name */
export function go(name) {
  if (page.peek() === name) return;
  history.pushState(null, "", `#${name}`);
  page.value = name;
}
