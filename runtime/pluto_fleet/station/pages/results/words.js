// What results are called, and how their values are written.

import { capital, clock, measured, number, percent, place, plain, t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { placeOf } from "./layers.js";

/** @import { Row } from "./table_model.js" */

/** A unit stands after its number, apart but for percent. @param {number} value @param {string | null} unit */
export const withUnit = (value, unit) => (unit ? `${measured(value)} ${unit}` : measured(value));

/** A number as the map has room for it: three digits. @param {number} value */
export const shortNumber = (value) => number(value, { maximumSignificantDigits: 3 });

/** @param {Quantity} one */
const quantityWords = ({ value, unit }) => withUnit(value, unit);

/** What a result is: its quantity, as the app calls it, or what was done. @param {Result} result */
export function whatWords({ kind, action, values, layers }) {
  if (kind === "photo") return t("results.photo");
  if (kind === "verdict") return t("results.verdict");
  const called = values.length && app.value?.layers.find(({ id, quantity, title }) =>
    title && quantity !== null && layers.includes(id));
  return (called && called.title) || capital(values[0]?.quantity ?? action ?? "");
}

/** Things seen, each once with how often: "bloom × 2, pest". @param {readonly string[]} tags */
export function tagWords(tags) {
  /** @type {Map<string, number>} */
  const counts = new Map();
  for (const tag of tags) counts.set(tag, (counts.get(tag) ?? 0) + 1);
  return [...counts].map(([tag, n]) => (n > 1 ? t("results.times", { tag: plain(tag), n }) : plain(tag)));
}

/** A result's value in words; empty: it has none. @param {Result} result */
export function valueWords({ value, values, tags }) {
  if (values.length) return values.map(quantityWords).join(", ");
  if (value !== null && typeof value === "object") return tagWords(value.sees).join(", ");
  if (typeof value === "boolean") return t(value ? "yes" : "no");
  if (typeof value === "number") return measured(value);
  return value ?? tagWords(tags).join(", ");
}

/** Where it was: the name of the place, or its coordinates. @param {Result} result */
export function placeWords(result) {
  const point = placeOf(result);
  return result.place ?? (point ? place(point) : "");
}

/** How its drone came home from that trip, where that was with less than its reserve; else empty. @param {Result} result */
export const drainedWords = ({ drained }) => (drained === null ? "" : t("results.drained", { level: percent(drained) }));

/** @param {Result} result @returns {Row} */
export function rowOf(result) {
  const words = {
    time: clock(result.time), what: whatWords(result), value: valueWords(result), place: placeWords(result),
    mission: result.mission, trip: result.trip ?? "", drone: result.drone ?? "",
  };
  const more = [...result.tags, drainedWords(result)];
  return { result, words, text: [...Object.values(words), ...more].join(" ").toLowerCase() };
}

/** What a layer is called: by the app, or by its quantity or kind. @param {ShownLayer} layer */
export function layerWords({ title, kind, quantity }) {
  if (title) return title;
  if (kind === "photos") return t("results.tab.photos");
  if (kind === "findings") return t("layer.findings");
  return quantity ? capital(quantity) : t("layer.values");
}

/** How sharp a photo is, from 0 to 1. @param {number} sharpness */
export const sharpnessWords = (sharpness) =>
  t("results.sharpness", { share: number(sharpness, { style: "percent", maximumFractionDigits: 0 }) });
