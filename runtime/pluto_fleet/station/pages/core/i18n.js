// All that is written, in the language and by the customs of who reads it: texts, numbers, times, quantities,
// and what the station says by a key and facts. texts/en.js is the catalogue, and those of other languages have
// the same keys, which the type checker holds. Only the chosen one is loaded.

import { batch, signal } from "@preact/signals";

/** @typedef {keyof typeof import("../texts/en.js").default} TextKey */
/** @typedef {string | { one: string, other: string }} Text a text, or its two numbers, by the fact n */
/** @typedef {"preflight.cannot" | "preflight.not-ready" | "preflight.promise" | "preflight.refused" | "question.other"} Quoted what others say in English */
/** @typedef {`said.${Exclude<Words["key"], Quoted>}`} SaidKey what the station says, which in English it says itself */
/** @typedef {Record<TextKey | SaidKey, Text>} Translated */
/** @typedef {Record<string, unknown>} Facts */

/** The languages, as each calls itself. */
export const LANGUAGES = { en: "English", it: "Italiano", de: "Deutsch" };
/** @typedef {keyof typeof LANGUAGES} Language */

export const language = signal(/** @type {Language} */ ("en"));
/** The place whose decimals and dates are written: that of the browser, where it speaks our language. */
export const locale = signal("en-GB");
const texts = signal(/** @type {Partial<Translated>} */ ({}));

/** @param {readonly string[]} wanted languages, the best first @returns {Language} */
export function bestLanguage(wanted) {
  const known = wanted.map((tag) => tag.split("-")[0].toLowerCase()).find((tag) => Object.hasOwn(LANGUAGES, tag));
  return /** @type {Language} */ (known ?? "en");
}

/** @type {Language | null} */
let wanted = null;

/** Speak a language from now on; where it cannot be loaded the old one stays. @param {Language} next */
export async function speak(next) {
  wanted = next;
  const { default: loaded } = await import(`../texts/${next}.js`);
  if (wanted !== next) return; // another one was chosen meanwhile
  batch(() => {
    texts.value = loaded;
    language.value = next;
    const near = navigator.languages.find((tag) => tag.split("-")[0] === next);
    locale.value = near ?? (next === "en" ? "en-GB" : next);
  });
  document.documentElement.lang = next;
}

/** @param {Text} text @param {Facts} facts */
function filled(text, facts) {
  let chosen = text;
  if (typeof chosen !== "string") {
    const rule = new Intl.PluralRules(language.value).select(Number(facts.n));
    chosen = rule === "one" ? chosen.one : chosen.other;
  }
  return chosen
    .replace(/\[([^\]]*)\]/g, (_, part) => (namesIn(part).every((name) => facts[name]) ? part : ""))
    .replace(FACT, (_, name) => written(facts[name]));
}

const FACT = /\{(\w+)\}/g;
/** @param {string} text */
const namesIn = (text) => [...text.matchAll(FACT)].map(([, name]) => name);

/** @param {unknown} fact @returns {string} */
function written(fact) {
  if (typeof fact === "number") return new Intl.NumberFormat(locale.value).format(fact);
  if (Array.isArray(fact)) return new Intl.ListFormat(locale.value).format(fact.map(String));
  return String(fact ?? "");
}

/** A text in the language of who reads it; its key where no language could be loaded. @param {TextKey | SaidKey} key @param {Facts} [facts] */
export const t = (key, facts = {}) => filled(texts.value[key] ?? key, facts);

/** Whether the catalogue has a text. @param {string} key @returns {key is TextKey | SaidKey} */
export const has = (key) => Object.hasOwn(texts.value, key);

/** A text that may be missing: of a status or a kind that only the app knows. @param {string} key @param {string} other */
export const tOr = (key, other) => (has(key) ? t(key) : other);

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

/** "2 missions": @param {"many.missions" | "many.trips" | "many.drones" | "many.others" | "many.lines" | "many.places" | "many.runs"} key @param {number} n */
export const many = (key, n) => t(key, { n });

/** @typedef {Words["facts"][string]} Fact */

const SHARES = ["battery", "has", "level", "needs", "supposed", "takes"];
const TIMES = ["ready_in", "seconds"];
const MASSES = ["mg", "g", "kg"];
/** @type {Record<string, "many.missions" | "many.drones" | "many.runs">} */
const COUNTED = { missions: "many.missions", drones: "many.drones", runs: "many.runs" };
const NAMED = 3; // of a list; the others are counted

/** @param {string} name @param {Fact} value */
function factWritten(name, value) {
  if (Array.isArray(value)) {
    return value.length > NAMED + 1 ? [...value.slice(0, NAMED), many("many.others", value.length - NAMED)] : value;
  }
  if (typeof value !== "number") return name === "action" ? plain(String(value)) : value;
  if (SHARES.includes(name)) return percent(value);
  if (TIMES.includes(name)) return duration(value);
  if (name === "mass") return inWords(value, MASSES);
  return Object.hasOwn(COUNTED, name) ? many(COUNTED[name], value) : value;
}

/** What a sentence's number depends on: its missions, its runs, or its drones. @param {Words["facts"]} facts */
function numberOf({ missions, runs, drones }) {
  const counted = missions ?? runs ?? drones;
  return Array.isArray(counted) ? counted.length : counted;
}

/** Whether it is said in the reader's language, and is not just a sentence of the station. @param {Words} words */
export const isTranslated = (words) => say(words) !== words.text;

/** What the station says, or its own English where the catalogue has no such key. @param {Words} words */
export function say({ key, facts, text }) {
  const own = `said.${key}`;
  if (!has(own)) return text;
  const all = Object.entries(facts).map(([name, value]) => [name, factWritten(name, value)]);
  return t(own, { n: numberOf(facts), ...Object.fromEntries(all) });
}
