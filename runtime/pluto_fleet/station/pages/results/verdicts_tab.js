// What evaluators said of missions: the newest first.

import { h } from "preact";
import { clock } from "../core/format.js";
import { t } from "../core/i18n.js";
import { Empty } from "../ui/parts.js";

/** @import { ResultsModel } from "./model.js" */

/** @param {{ model: ResultsModel }} props */
export function VerdictsTab({ model }) {
  const verdicts = model.results.value.filter(({ kind }) => kind === "verdict").toReversed();
  if (!verdicts.length) return h(Empty, null, t("results.none.verdicts"));
  return h("ul", { class: "verdicts" }, verdicts.map(({ number, time, mission, value }) =>
    h("li", { key: number }, h("p", { class: "row" }, h("strong", null, mission), h("span", { class: "muted num" }, clock(time))),
      h("p", { class: "user-text" }, String(value)))));
}
