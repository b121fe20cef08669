// What the colours on the map stand for; and the layers of the map: on or off, how opaque, and what each has.

import { h } from "preact";
import { percent, plain, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { Check, Empty, Input } from "../ui/parts.js";
import { gradient } from "./heat.js";
import { colourOf, USUAL_OPACITY } from "./map_layers.js";
import { layerWords, shortNumber } from "./words.js";

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

/** @param {{ model: ResultsModel }} props */
export function LayersTab({ model }) {
  const layers = model.layers.value;
  if (!layers.length) return h(Empty, null, t("results.none.never"));
  return h("ul", { class: "layer-list" }, layers.map((layer) => h(LayerRow, { key: layer.id, layer, model })));
}

/** @param {{ layer: ShownLayer, model: ResultsModel }} props */
function LayerRow({ layer, model }) {
  const { id, kind, results } = layer;
  const isOn = model.on.value.has(id);
  const name = layerWords(layer);
  return h("li", { class: "layer-row stack" },
    h(Check, { checked: isOn, onTick: (yes) => model.turn(id, yes) },
      h("strong", null, name), h("span", { class: "muted num" }, t(`layer.count.${kind}`, { n: results.length }))),
    !results.length && h("p", { class: "hint" }, t(`layer.empty.${kind}`)),
    isOn && results.length > 0 && h("div", { class: "stack" },
      h(Scale, { layer }),
      kind === "findings" && h(Counts, { model }),
      (kind === "heat" || kind === "photos") && h(Opacity, { id, name, usual: kind === "heat" ? USUAL_OPACITY : 1 })));
}

/** @param {{ id: string, name: string, usual: number }} props */
function Opacity({ id, name, usual }) {
  const value = prefs.opacity.value[id] ?? usual;
  return h("label", { class: "opacity" }, h("span", { class: "muted" }, t("layer.opacity")),
    h(Input, {
      class: "", type: "range", min: 0.1, max: 1, step: 0.1, value, "aria-label": t("layer.opacity-of", { layer: name }),
      "aria-valuetext": percent(value),
      onText: (text) => { prefs.opacity.value = { ...prefs.opacity.peek(), [id]: Number(text) }; },
    }));
}

/** How often each kind was found; pressed, the table has those alone. @param {{ model: ResultsModel }} props */
function Counts({ model }) {
  const counts = model.counts.value;
  const list = (/** @type {string} */ tag) => {
    model.filter({ tag });
    prefs.resultsTab.value = "table";
  };
  return h("ul", { class: "tag-counts" }, counts.map(({ tag, count, places }) => h("li", { key: tag },
    h("button", { type: "button", class: "link", onClick: () => list(tag) },
      h(Swatch, { colour: colourOf(counts, tag) }), h("span", null, plain(tag))),
    h("span", { class: "num muted" }, t("layer.found", { count, n: places })))));
}
