// Mishaps of simulated drones, to rehearse what people do then.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { perform } from "../core/station.js";
import { Button } from "../ui/button.js";

const KINDS = /** @type {const} */ (["lost", "crash", "battery", "uncertain"]);

/** @param {{ id: string }} props */
export const Mishaps = ({ id }) => h("details", { class: "mishaps" },
  h("summary", null, t("mishap.title")),
  h("p", { class: "hint" }, t("mishap.hint")),
  h("div", { class: "row" }, KINDS.map((kind) => h(Button, {
    key: kind, small: true, onClick: () => { perform("mishap", { drone: id, kind }); },
  }, t(`mishap.${kind}`)))));
