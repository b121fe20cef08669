// One result, with all that is known of it, and its place on the map where no card covers it: the card lies at the
// left, on a phone below the map.

import { h } from "preact";
import { clock, inWords, place, plain, t } from "../core/i18n.js";
import { onEarth } from "../core/landmarks.js";
import { pictureAt } from "../map/ground.js";
import { toPixels } from "../map/view.js";
import { Button, IconButton } from "../ui/parts.js";
import { placeOf } from "./layers.js";
import { drainedWords, sharpnessWords, tagWords, valueWords, whatWords } from "./words.js";

const CLOSE = 80; // pixels a metre, at which a photo is seen

/** What is known of a result, as pairs of a name and its words. @param {Result} result @returns {[string, string][]} */
export function facts(result) {
  const { mission, trip, drone, time, round, parameters, value, tags, place: name } = result;
  const point = placeOf(result);
  const given = Object.entries(parameters).map(([key, one]) => `${plain(key)} ${inWords(one)}`);
  const isPhoto = value !== null && typeof value === "object";
  /** @type {[string, string][]} */
  const all = [
    [t("column.place"), [name, point && place(point)].filter(Boolean).join(", ")],
    [t("results.on-earth"), point ? onEarth(point) : ""],
    [t("column.time"), clock(time)],
    [t("column.mission"), mission],
    [t("column.trip"), trip ?? ""],
    [t("results.round"), round ? String(round) : ""],
    [t("column.drone"), drone ?? ""],
    [t("results.battery"), drainedWords(result)],
    [t("results.parameters"), given.join(", ")],
    [t("results.sees"), isPhoto ? tagWords(value.sees).join(", ") || t("results.sees-nothing") : ""],
    [t("results.found"), isPhoto ? "" : tagWords(tags).join(", ")],
  ];
  return all.filter(([, words]) => words);
}

/** @param {{ result: Result }} props */
export const Facts = ({ result }) => h("dl", { class: "facts" }, facts(result).map(([name, words]) =>
  h("div", { key: name }, h("dt", null, name), h("dd", null, words))));

/** @param {{ model: ResultsModel, camera: Camera, onConsole: (result: Result) => void, consoleWords: string }} props */
export function ResultCard({ model, camera, onConsole, consoleWords }) {
  const result = model.find(model.chosen.value);
  if (!result) return null;
  const point = placeOf(result);
  const { value } = result;
  const photo = value !== null && typeof value === "object" ? value : null;
  const picture = photo?.picture ? pictureAt(`${photo.picture}&size=thumb`) : null;
  const what = whatWords(result);
  return h("section", { class: "result-card", "aria-label": what },
    h("div", { class: "row" }, h("h3", null, what), h("span", { class: "spread" }),
      h(IconButton, { icon: "close", label: t("close"), onClick: () => { model.chosen.value = null; } })),
    photo ? h("p", { class: "muted" }, sharpnessWords(photo.sharpness)) : h("p", { class: result.values.length ? "result-value" : "user-text" }, valueWords(result) || t("results.no-value")),
    picture && h("img", { src: picture, alt: t("results.photo-alt", { place: result.place ?? result.mission }) }),
    h(Facts, { result }),
    h("div", { class: "row" },
      photo && h(Button, { small: true, icon: "photo", onClick: () => { model.opened.value = result.number; } }, t("results.open-photo")),
      point && h(Button, { small: true, icon: "map", onClick: () => revealBeside(camera, point[0], point[1], CLOSE) }, t("results.show-on-map")),
      h(Button, { small: true, icon: "list", onClick: () => onConsole(result) }, consoleWords)));
}

const CARD = 340; // pixels of its width
const NARROW = 520; // pixels of a map that is above its card
const EDGE = 40;

/** @param {Camera} camera @param {number} x @param {number} y metres @param {number} [closest] the scale to show it at, if it is not shown larger */
export function revealBeside(camera, x, y, closest = 0) {
  const { width, height } = camera.box.peek();
  if (!width) return;
  const view = camera.view.peek();
  const left = width < NARROW ? EDGE : CARD + EDGE;
  const at = toPixels(view, x, y);
  const isSeen = at.x > left && at.x < width - EDGE && at.y > EDGE && at.y < height - EDGE;
  const scale = Math.max(view.scale, closest);
  if (isSeen && scale === view.scale) return;
  const middle = { x: (left + width - EDGE) / 2, y: height / 2 };
  camera.look({ scale, left: middle.x - x * scale, bottom: middle.y + y * scale });
}
