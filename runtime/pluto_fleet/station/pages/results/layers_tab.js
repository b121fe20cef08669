// The layers of the map: on or off, how opaque, and what each has.

import { h } from "preact";
import { percent, plain } from "../core/format.js";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { Empty } from "../ui/parts.js";
import { USUAL_OPACITY } from "./heat_layer.js";
import { Scale, Swatch } from "./legend.js";
import { colourOf } from "./pin_layer.js";
import { layerWords } from "./words.js";

/** @import { ShownLayer } from "./layers.js" */
/** @import { ResultsModel } from "./model.js" */

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
    h("label", { class: "check" },
      h("input", {
        type: "checkbox", checked: isOn,
        onChange: (/** @type {Event} */ { currentTarget }) =>
          model.turn(id, /** @type {HTMLInputElement} */ (currentTarget).checked),
      }),
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
    h("input", {
      type: "range", min: 0.1, max: 1, step: 0.1, value, "aria-label": t("layer.opacity-of", { layer: name }),
      "aria-valuetext": percent(value),
      onInput: (/** @type {Event} */ { currentTarget }) => {
        const now = Number(/** @type {HTMLInputElement} */ (currentTarget).value);
        prefs.opacity.value = { ...prefs.opacity.peek(), [id]: now };
      },
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
