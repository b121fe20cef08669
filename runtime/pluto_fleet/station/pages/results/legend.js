// What the colours on the map stand for.

import { h } from "preact";
import { plain } from "../core/format.js";
import { t } from "../core/i18n.js";
import { gradient } from "./colours.js";
import { colourOf } from "./pin_layer.js";
import { layerWords, shortNumber } from "./words.js";

/** @import { ShownLayer } from "./layers.js" */
/** @import { ResultsModel } from "./model.js" */

/** The colours of a layer of numbers, with the values at their ends. @param {{ layer: ShownLayer }} props */
export const Scale = ({ layer: { range, unit } }) => range && h("div", { class: "scale" },
  h("div", { class: "scale-bar-colours", style: { background: gradient }, "aria-hidden": true }),
  h("div", { class: "scale-ends num" }, [range.low, range.high].map((end, at) => h("span", { key: at }, unit ? `${shortNumber(end)} ${unit}` : shortNumber(end)))));

/** @param {{ model: ResultsModel }} props */
export function Legend({ model }) {
  const scales = model.numbers().filter(({ range }) => range);
  const counts = model.counts.value;
  if (!scales.length && !counts.length) return null;
  return h("section", { class: "legend", "aria-label": t("legend") },
    scales.map((layer) => h("div", { key: layer.id, class: "legend-layer" },
      h("strong", null, layerWords(layer)), h(Scale, { layer }),
      layer.kind === "heat" && h("p", { class: "hint" }, t("legend.unknown")))),
    counts.length > 0 && h("ul", { class: "legend-tags" }, counts.map(({ tag, count }) =>
      h("li", { key: tag }, h(Swatch, { colour: colourOf(counts, tag) }), h("span", null, plain(tag)),
        h("span", { class: "num muted" }, count)))));
}

/** @param {{ colour: string }} props */
export const Swatch = ({ colour }) =>
  h("span", { class: "swatch", "aria-hidden": true, style: { background: colour } });
