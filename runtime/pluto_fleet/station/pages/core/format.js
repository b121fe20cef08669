// Numbers, times and quantities, as they are written where the reader lives.

import { locale, t } from "./i18n.js";

/** @param {number} value @param {Intl.NumberFormatOptions} [options] */
export const number = (value, options = { maximumFractionDigits: 2 }) =>
  new Intl.NumberFormat(locale.value, options).format(value);

/** Six digits of a measured value. @param {number} value */
export const measured = (value) => number(value, { maximumSignificantDigits: 6 });

/** @param {number | null} share from 0 to 1 */
export const percent = (share) =>
  (share === null ? "–" : number(share, { style: "percent", maximumFractionDigits: 0 }));

/** A place: "1.5, 2 m". @param {readonly number[]} point */
export const place = ([x, y]) => `${number(x)}; ${number(y)} m`;

/** 75 → "1:15". @param {number} seconds */
export function clock(seconds) {
  const all = Math.max(0, Math.floor(seconds));
  const [hours, minutes] = [Math.floor(all / 3600), Math.floor(all / 60) % 60];
  const two = (/** @type {number} */ value) => String(value).padStart(2, "0");
  return hours ? `${hours}:${two(minutes)}:${two(all % 60)}` : `${minutes}:${two(all % 60)}`;
}

/** 75 → "1 min 15 s". @param {number} seconds */
export function duration(seconds) {
  const all = Math.max(0, Math.round(seconds));
  const [hours, minutes, rest] = [Math.floor(all / 3600), Math.floor(all / 60) % 60, all % 60];
  const parts = [hours && `${hours} h`, minutes && `${minutes} min`, !hours && rest && `${rest} s`];
  return parts.filter(Boolean).join(" ") || "0 s";
}

/** What need not be known to the second: 75 → "1 min". @param {number} seconds */
export function roughly(seconds) {
  if (seconds < 60) return duration(seconds);
  const hours = Math.floor(seconds / 3600);
  return hours ? `${hours} h` : `${Math.floor(seconds / 60)} min`;
}

/** A moment, with its day if that is not today's. @param {number} at milliseconds since 1970 */
export function moment(at) {
  const date = new Date(at);
  const today = date.toDateString() === new Date().toDateString();
  return new Intl.DateTimeFormat(locale.value, {
    ...(today ? {} : { dateStyle: "medium" }), timeStyle: "short",
  }).format(date);
}

/** A moment with its day, as on paper. @param {number} at milliseconds since 1970 */
export const dated = (at) =>
  new Intl.DateTimeFormat(locale.value, { dateStyle: "long", timeStyle: "short" }).format(new Date(at));

/** A name of a program as people write it: `take_photo` → "take photo". @param {string} name */
export const plain = (name) => name.replaceAll("_", " ");

/** @param {string} name */
export const capital = (name) => plain(name).replace(/^./, (first) => first.toUpperCase());

// Quantities stay as they were typed, "3 min", "40 mg"; a number alone is in SI units.
/** @type {Record<string, number>} */
const FACTORS = {
  ms: 0.001, s: 1, min: 60, h: 3600, mm: 0.001, cm: 0.01, m: 1, km: 1000, mg: 1e-6, g: 0.001, kg: 1,
  deg: Math.PI / 180, rad: 1, "%": 0.01, "m/s": 1, "km/h": 1 / 3.6, C: 1, K: 1,
};
/** @type {Record<string, number>} */
const OFFSETS = { C: 273.15 };
const USUAL = ["s", "g", "m", "deg", "%", "m/s", "C"];
export const TIME = ["s", "min", "h"];
const LARGEST = 1e15; // what the station takes as a number
const AMOUNT = /^\s*([+-]?\d+(?:[.,]\d+)?)\s*([A-Za-z%/]*)\s*$/;

/** In the largest unit in which it is 1 or more, else in the smallest: 180 → "3 min". @param {number} si @param {string[]} units */
function inUnits(si, units) {
  const of = (/** @type {string} */ unit) => (si - (OFFSETS[unit] ?? 0)) / FACTORS[unit];
  const by = units.toSorted((a, b) => FACTORS[b] - FACTORS[a]);
  const best = by.find((unit) => Math.abs(of(unit)) >= 1) ?? by.at(-1) ?? "";
  return `${Number(of(best).toPrecision(6))} ${best}`;
}

/** A value of a plan as it is written in a field. @param {Scalar} value @param {string[]} [units] */
export const inWords = (value, units = []) =>
  (typeof value === "number" && units.length ? inUnits(value, units) : String(value));

/** The number that was typed, with a comma or a point, or the text if it is none. @param {string} text */
export function typedNumber(text) {
  const value = Number(text.replace(",", "."));
  return text.trim() && Math.abs(value) <= LARGEST ? value : text;
}

/**
 * What was typed as a quantity: "3" of seconds → "3 s", so that it is seen what was understood.
 * @param {string} text @param {string[]} units @param {string} unit of a number without one
 */
export function typedQuantity(text, units, unit) {
  const [, value, of] = (units.length && AMOUNT.exec(text)) || [];
  return value ? `${typedNumber(value)} ${of || unit}` : text.trim();
}

/** The unit of a number without one. @param {string[]} units @param {string} usual the default, in words */
export const usualUnit = (units, usual) =>
  (usual.split(" ")[1] || USUAL.find((one) => units.includes(one))) ?? units[0] ?? "";

/** "2 missions": @param {"many.missions" | "many.trips" | "many.drones" | "many.others" | "many.lines" | "many.runs"} key @param {number} n */
export const many = (key, n) => t(key, { n });
