// A place for the page.

import { h } from "./dom.js";

export function trips() {
  return { element: h("p", { class: "card" }, "This page is being built.") };
}
