// The results on the floor plan: heat maps as rasters that are stretched over it, photos on the ground that each
// covers, the sharpest on top, findings as pins with their numbers, and measured values where they were
// measured. They are pressed and pointed at by where they are; by keyboard, everything is in the table.

import { computed } from "@preact/signals";
import { h } from "preact";
import { useMemo } from "preact/hooks";
import { prefs } from "../core/prefs.js";
import { Mark, Tags, useCamera } from "../map/camera.js";
import { landmarkNames, pictureAt } from "../map/ground.js";
import { toPixels } from "../map/view.js";
import { useCalm } from "../ui/hooks.js";
import { colourAt, css, Field, KINDS, rasterOf, samplesOf, shareOf } from "./heat.js";
import { numberOf, placeOf, spotsOf } from "./layers.js";
import { shortNumber } from "./words.js";

/** @import { Raster } from "./heat.js" */

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

const LEAST = 40; // pixels across, from which on the picture is drawn
const MOST_PICTURES = 300;

/** @param {PhotoOnMap} photo @param {View} view @param {Box} box */
function isInView({ x, y, width, height }, { left, bottom, scale }, box) {
  const [middle, line] = [left + x * scale, bottom - y * scale];
  const [half, high] = [(width * scale) / 2, (height * scale) / 2];
  return middle + half > 0 && middle - half < box.width && line + high > 0 && line - high < box.height;
}

/** @param {{ model: ResultsModel }} props */
export function PhotoLayer({ model }) {
  const camera = useCamera();
  const view = useCalm(camera.view, 200).value;
  const photos = model.photos.value;
  const seen = photos.filter((photo) => photo.picture !== null && photo.width * view.scale > LEAST
    && isInView(photo, view, camera.box.peek())).slice(-MOST_PICTURES);
  const pictured = new Set(seen.map(({ result }) => result.number));
  const layer = model.shown.value.find(({ kind }) => kind === "photos");
  const chosen = photos.find(({ result }) => result.number === model.chosen.value);
  return h("g", { class: "layer photos", "aria-hidden": true, opacity: layer ? prefs.opacity.value[layer.id] ?? 1 : 1 },
    photos.map((photo) => h(Photo, {
      key: photo.result.number, photo, isDrawn: pictured.has(photo.result.number),
    })),
    chosen && h(Outline, { photo: chosen }));
}

/** @param {{ photo: PhotoOnMap, isDrawn: boolean }} props */
function Photo({ photo: { x, y, width, height, picture, result, sharpness }, isDrawn }) {
  const address = isDrawn && picture !== null ? pictureAt(`${picture}&size=thumb`) : null;
  const [left, low] = [x - width / 2, y - height / 2];
  if (!address) {
    return h("rect", { class: "footprint", x: left, y: low, width, height, "data-result": result.number, "data-sharp": sharpness >= 0.7 });
  }
  return h("image", {
    class: "thumb", "data-result": result.number, href: address, width, height, preserveAspectRatio: "none",
    transform: `translate(${left} ${low + height}) scale(1 -1)`,
  });
}

/** @param {{ photo: PhotoOnMap }} props */
const Outline = ({ photo: { x, y, width, height } }) =>
  h("rect", { class: "footprint chosen", x: x - width / 2, y: y - height / 2, width, height });

const MOST_DOTS = 1000; // more would hide the colours under them
const APART = 18; // pixels between pins at one place
const DROP = "M0 0C-3 -6 -8 -9 -8 -15A8 8 0 0 1 8 -15C8 -9 3 -6 0 0Z";

/** The colour of a kind of finding, by its rank. @param {readonly { tag: string }[]} counts @param {string} tag */
export const colourOf = (counts, tag) =>
  KINDS[Math.max(0, counts.findIndex((one) => one.tag === tag)) % KINDS.length];

/** Side by side, where there are several kinds. @param {readonly Pin[]} pins @returns {Map<string, number>} pixels to the right, by key */
function spread(pins) {
  /** @type {Map<string, Pin[]>} */
  const groups = new Map();
  for (const pin of pins) {
    const place = `${pin.x} ${pin.y}`;
    groups.set(place, [...groups.get(place) ?? [], pin]);
  }
  return new Map([...groups.values()].flatMap((group) =>
    group.map(({ key }, at) => [key, (at - (group.length - 1) / 2) * APART])));
}

/** @param {{ model: ResultsModel }} props */
export function PinLayer({ model }) {
  const [pins, counts] = [model.pins.value, model.counts.value];
  const chosen = model.find(model.chosen.value);
  const beside = spread(pins);
  return h("g", { class: "layer pins", "aria-hidden": true },
    model.numbers().map((layer) => h(Dots, { key: layer.id, layer })),
    pins.map(({ key, tag, x, y, count }) => h(Mark, { key, x, y, class: "finding" },
      h("g", { "data-tag": tag, transform: `translate(${beside.get(key)} 0)` },
        h("path", { d: DROP, fill: colourOf(counts, tag) }),
        h("text", { y: -11 }, count > 1 ? count : tag.slice(0, 1).toUpperCase())))),
    chosen && h(Chosen, { place: placeOf(chosen) }));
}

/** @param {{ place: readonly number[] | null }} props */
const Chosen = ({ place }) => place && h(Mark, { x: place[0], y: place[1], class: "chosen-place" },
  h("circle", { r: 13 }));

/** Where values were measured, as far as that is in view. @param {{ layer: ShownLayer }} props */
function Dots({ layer }) {
  const camera = useCamera();
  const view = useCalm(camera.view, 200).value;
  const { width, height } = camera.box.value;
  const seen = spotsOf(layer.results).filter(({ x, y }) => {
    const at = toPixels(view, x, y);
    return at.x > 0 && at.y > 0 && at.x < width && at.y < height;
  });
  return h("g", null, seen.slice(-MOST_DOTS).map(({ x, y, results: [result] }) => {
    const number = numberOf(result, layer.quantity);
    return number && layer.range && h(Mark, { key: `${x} ${y}`, x, y, class: "value" },
      h("circle", { r: 5, fill: css(colourAt(shareOf(number.value, layer.range))), "data-value": number.value }));
  }));
}

/** The values themselves and the names of places, as far as there is room. @param {{ model: ResultsModel }} props */
export function MapLabels({ model }) {
  const camera = useCamera();
  const view = useCalm(camera.view, 150).value;
  const values = model.numbers().flatMap((layer) => spotsOf(layer.results).map(({ x, y, results: [result] }) => {
    const number = numberOf(result, layer.quantity);
    return {
      key: `${layer.id} ${result.number}`, text: number ? shortNumber(number.value) : "", gap: 8, kind: "",
      importance: number?.value ?? 0, ...toPixels(view, x, y),
    };
  }));
  const box = camera.box.value;
  const names = landmarkNames(view, box).map((label) => ({ ...label, ...toPixels(view, label.x, label.y), importance: Infinity }));
  return h(Tags, { labels: [...names, ...values], box });
}
