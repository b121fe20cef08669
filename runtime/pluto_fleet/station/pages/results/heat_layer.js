// A heat map on the floor plan: a raster that is stretched over the map, and so is moved with it.

import { computed } from "@preact/signals";
import { h } from "preact";
import { useMemo } from "preact/hooks";
import { prefs } from "../core/prefs.js";
import { useCalm } from "../ui/calm.js";
import { Field, rasterOf, samplesOf } from "./heat.js";

/** @import { Raster } from "./heat.js" */
/** @import { ShownLayer } from "./layers.js" */
/** @import { ResultsModel } from "./model.js" */

const ANEW_EVERY = 500; // ms
export const USUAL_OPACITY = 0.8;

/** @param {Raster} raster @returns {string} an address */
function drawn({ width, height, data }) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  canvas.getContext("2d")?.putImageData(new ImageData(data, width, height), 0, 0);
  return canvas.toDataURL();
}

/** @param {{ model: ResultsModel, size: readonly number[] }} props */
export const HeatLayers = ({ model, size }) => h("g", { class: "heat-layers", "aria-hidden": true },
  model.shown.value.filter(({ kind, range }) => kind === "heat" && range).map(({ id }) =>
    h(HeatLayer, { key: id, id, model, size })));

/** @param {{ id: string, model: ResultsModel, size: readonly number[] }} props */
function HeatLayer({ id, model, size }) {
  const layer = useMemo(() => computed(() => model.layers.value.find((one) => one.id === id)), [model, id]);
  const now = useCalm(layer, ANEW_EVERY).value;
  const address = useMemo(() => (now?.range
    ? drawn(rasterOf(new Field(samplesOf(now), now.reach), size, now.range)) : ""), [now, size]);
  return address && h("image", {
    class: "heat", "data-layer": id, href: address, width: size[0], height: size[1], preserveAspectRatio: "none",
    transform: `translate(0 ${size[1]}) scale(1 -1)`, opacity: prefs.opacity.value[id] ?? USUAL_OPACITY,
  });
}

/** What a heat map says of a point; null where no layer knows. @param {ShownLayer[]} layers those that are on @param {number} x @param {number} y */
export function estimated(layers, x, y) {
  const layer = layers.findLast(({ kind, range }) => kind === "heat" && range);
  const value = layer && new Field(samplesOf(layer), layer.reach).at(x, y);
  return layer && value !== null && value !== undefined ? { layer, value } : null;
}
