// Help: the three steps, what the colours and signs mean, the keys, and the settings of this browser.

import { h } from "preact";
import { t, tOr } from "../core/i18n.js";
import { Standing } from "../ui/standing.js";
import { Settings } from "./settings.js";

const STEPS = /** @type {const} */ (["missions", "trips", "start"]);
const DRONES = ["FREE", "BUSY", "RETURNING", "CHARGING", "LOW", "UNKNOWN", "LOST", "RETIRED"];
/** @type {readonly (readonly [string[], "keys.tabs" | "keys.map" | "keys.zoom" | "keys.whole" | "keys.pins" | "keys.fine" | "keys.delete" | "keys.undo" | "keys.reorder" | "keys.open" | "keys.hold" | "keys.close" | "keys.actions" | "keys.places" | "keys.new" | "keys.several"])[]} */
const KEYS = [
  [["←", "→"], "keys.tabs"], [["←", "→", "↑", "↓"], "keys.map"], [["+", "−"], "keys.zoom"], [["0"], "keys.whole"],
  [["←", "→", "↑", "↓"], "keys.pins"], [["Shift"], "keys.fine"], [["Delete"], "keys.delete"],
  [["Ctrl+Z", "Ctrl+Y"], "keys.undo"], [["Alt+↑", "Alt+↓"], "keys.reorder"], [["Enter"], "keys.open"],
  [["1", "9"], "keys.actions"], [["↓"], "keys.places"], [["N"], "keys.new"], [["Ctrl+A", "Ctrl+D"], "keys.several"],
  [["Space"], "keys.hold"], [["Esc"], "keys.close"],
];

/** "Ctrl+Z", as the reader's keyboard calls it. @param {string} key */
const named = (key) => key.split(/(?<=.)\+/).map((one) => tOr(`key.${one}`, one)).join("+");

export default function Help() {
  return h("div", { class: "help-columns" },
    h("section", { class: "card stack", "aria-labelledby": "steps" },
      h("h2", { id: "steps" }, t("help.steps")),
      h("ol", { class: "stack" }, STEPS.map((name) => h("li", { key: name },
        h("h3", null, t(`tour.${name}`)), h("p", { class: "muted" }, t(`tour.${name}-text`))))),
      h("h3", null, t("tour.stop")), h("p", { class: "muted" }, t("tour.stop-text"))),
    h(Settings, null),
    h("section", { class: "card stack", "aria-labelledby": "signs" },
      h("h2", { id: "signs" }, t("help.signs")),
      h("dl", { class: "signs" }, DRONES.map((status) => h("div", { key: status },
        h("dt", null, h(Standing, { status })), h("dd", { class: "muted" }, t(/** @type {any} */ (`help.${status}`))))))),
    h("section", { class: "card stack", "aria-labelledby": "keys" },
      h("h2", { id: "keys" }, t("help.keys")),
      h("table", { class: "table" }, h("tbody", null, KEYS.map(([keys, what]) => h("tr", { key: what },
        h("td", null, keys.map((key) => h("kbd", { key, class: "key" }, named(key)))), h("td", null, t(what))))))));
}
