// What one sees first, where the plan is still empty: what to do, in three steps.

import { h } from "./dom.js";
import { icon } from "./icons.js";

function step(n, sign, title, text) {
  return h("li", { class: "welcome-step" },
    h("span", { class: "welcome-sign", "aria-hidden": "true" }, icon(sign)),
    h("h3", {}, `${n}. ${title}`), h("p", { class: "muted" }, text));
}

export function welcome(context, { add, example, read }) {
  return h("section", { class: "card welcome stack", "aria-labelledby": "welcome" },
    h("h2", { id: "welcome" }, "Nothing is planned yet"),
    h("p", { class: "muted" }, "A mission is a series of trips: a drone flies to a place, ",
      "and does something there. Three steps, and it flies:"),
    h("ol", { class: "welcome-steps" },
      step(1, "plus", "Add a mission", "Give it a name. Add as many as you like: "
        + "they fly side by side, as far as there are drones."),
      step(2, "map", "Set its trips",
        "Drag actions from the list onto the map, in the order of the trips."),
      step(3, "start", "Press Start",
        "Watch it on the page Monitor. The two Stop buttons act at once.")),
    h("div", { class: "row" },
      h("button", { class: "button primary", onclick: add }, icon("plus"), "Add the first mission"),
      h("button", { class: "button", onclick: example }, "Use the example plan"),
      h("button", { class: "button", onclick: read }, icon("import"), "Import a missions file")),
    h("p", { class: "hint" }, "More is on the page ",
      h("a", { href: "#help", onclick: (event) => { event.preventDefault(); context.go("help"); } },
        "Help"), "."));
}
