// Findings as pins with their numbers, and measured values where they were measured. They are pressed
// and pointed at by where they are; by keyboard, everything is in the table.

import { h } from "preact";
import { useCamera, Mark } from "../map/camera.js";
import { LINE, placed } from "../map/labels.js";
import { landmarkNames } from "../map/landmarks.js";
import { toPixels } from "../map/view.js";
import { useCalm } from "../ui/calm.js";
import { colourAt, css, KINDS, shareOf } from "./colours.js";
import { spotsOf } from "./hit.js";
import { numberOf, placeOf } from "./layers.js";
import { shortNumber } from "./words.js";

/** @import { Pin, ShownLayer } from "./layers.js" */
/** @import { ResultsModel } from "./model.js" */

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
  const seen = spotsOf(layer.results, placeOf).filter(({ x, y }) => {
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
  const values = model.numbers().flatMap((layer) => spotsOf(layer.results, placeOf).map(({ x, y, results: [result] }) => {
    const number = numberOf(result, layer.quantity);
    return {
      key: `${layer.id} ${result.number}`, text: number ? shortNumber(number.value) : "", gap: 8, kind: "",
      importance: number?.value ?? 0, ...toPixels(view, x, y),
    };
  }));
  const names = landmarkNames.value.map((label) => ({ ...label, ...toPixels(view, label.x, label.y), importance: Infinity }));
  return h("div", { class: "names", "aria-hidden": true }, placed([...names, ...values], camera.box.value).map(({ key, text, left, top, width, kind }) =>
    h("span", {
      key, class: `name ${kind ?? ""}`, style: { transform: `translate(${left}px, ${top}px)`, width: `${width}px`, height: `${LINE}px` },
    }, text)));
}
