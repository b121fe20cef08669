// Which page is open: it stands in the address after #, so that Back goes back.

import { batch, signal } from "@preact/signals";

export const PAGES = /** @type {const} */ (
  ["missions", "trips", "monitor", "results", "history", "map", "help"]);
/** @typedef {typeof PAGES[number]} PageName */

const fromAddress = () => {
  const [name, ...rest] = location.hash.slice(1).split("/");
  const part = name === "history" ? decodeURIComponent(rest.join("/")) : "";
  return { name: PAGES.find((one) => one === name) ?? "missions", part };
};

export const page = signal(/** @type {PageName} */ (fromAddress().name));
/** What is open within the page: a flight of the past; empty: nothing. */
export const part = signal(fromAddress().part);
/** A field that a page is to go to, when it is shown. */
export const wantedField = signal(/** @type {{ trip: string | null, field: string | null } | null} */ (null));

window.addEventListener("popstate", () => {
  const { name, part: within } = fromAddress();
  batch(() => {
    page.value = name;
    part.value = within;
  });
});

/** Open a page, or what is within it. @param {PageName} name @param {string} [within] */
export function go(name, within = "") {
  if (page.peek() === name && part.peek() === within) return;
  history.pushState(null, "", `#${name}${within && `/${encodeURIComponent(within)}`}`);
  batch(() => {
    page.value = name;
    part.value = within;
  });
}
