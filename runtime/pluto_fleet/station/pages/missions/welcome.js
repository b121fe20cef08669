// What an empty plan says: three steps, and where to begin.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { mayFly } from "../core/station.js";
import { Button } from "../ui/button.js";
import { example, importFile } from "./files.js";

const STEPS = /** @type {const} */ (["add", "trips", "start"]);

/** @param {{ onAdd: () => void, children?: ComponentChildren }} props */
export const Welcome = ({ onAdd, children }) => h("section", { class: "card welcome stack" },
  h("h2", null, t("missions.nothing")), h("p", { class: "muted" }, t("missions.what-is-one")),
  h("ol", { class: "welcome-steps" }, STEPS.map((step) => h("li", { key: step },
    h("h3", null, t(`missions.step.${step}`)), h("p", { class: "muted" }, t(`missions.step.${step}-more`))))),
  mayFly.value && h("div", { class: "row" },
    h(Button, { kind: "primary", icon: "plus", onClick: onAdd }, t("missions.add-first")),
    h(Button, { onClick: () => { example(); } }, t("missions.example")),
    h(Button, { onClick: importFile }, t("missions.import-file")), children),
  h("p", { class: "hint" }, h("a", { href: "#help" }, t("missions.more-help"))));
