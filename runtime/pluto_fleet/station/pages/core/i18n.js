// All texts of the pages, in the language of who reads them: texts/en.js is the catalogue, and those
// of other languages have the same keys, which the type checker holds.

import { signal } from "@preact/signals";
import en from "../texts/en.js";

/** @import { Words } from "../wire" */
/** @typedef {keyof typeof en} TextKey */
/** @typedef {string | { one: string, other: string }} Text a text, or its two numbers, by the fact n */
/** @typedef {Record<string, unknown>} Facts */

/** The languages, as each calls itself. */
export const LANGUAGES = { en: "English", it: "Italiano", de: "Deutsch" };
/** @typedef {keyof typeof LANGUAGES} Language */

const LOADERS = {
  en: async () => en,
  it: async () => (await import("../texts/it.js")).default,
  de: async () => (await import("../texts/de.js")).default,
};

export const language = signal(/** @type {Language} */ ("en"));
/** The place whose decimals and dates are written: that of the browser, where it speaks our language. */
export const locale = signal("en-GB");
const texts = signal(/** @type {Record<TextKey, Text>} */ (en));

/** @param {readonly string[]} wanted languages, the best first @returns {Language} */
export function bestLanguage(wanted) {
  const known = wanted.map((tag) => tag.slice(0, 2)).find((tag) => tag in LANGUAGES);
  return /** @type {Language} */ (known ?? "en");
}

/** Speak a language from now on. @param {Language} next */
export async function speak(next) {
  texts.value = await LOADERS[next]();
  language.value = next;
  const near = navigator.languages.find((tag) => tag.startsWith(next));
  locale.value = near ?? (next === "en" ? "en-GB" : next);
  document.documentElement.lang = next;
}

/** @param {Text} text @param {Facts} facts */
function filled(text, facts) {
  let chosen = text;
  if (typeof chosen !== "string") {
    const rule = new Intl.PluralRules(language.value).select(Number(facts.n));
    chosen = rule === "one" ? chosen.one : chosen.other;
  }
  return chosen.replace(/\{(\w+)\}/g, (_, name) => written(facts[name]));
}

/** @param {unknown} fact @returns {string} */
function written(fact) {
  if (typeof fact === "number") return new Intl.NumberFormat(locale.value).format(fact);
  if (Array.isArray(fact)) return new Intl.ListFormat(language.value).format(fact.map(String));
  return String(fact ?? "");
}

/** A text in the language of who reads it. @param {TextKey} key @param {Facts} [facts] */
export const t = (key, facts = {}) => filled(texts.value[key], facts);

/** Whether the catalogue has a text. @param {string} key @returns {key is TextKey} */
export const has = (key) => key in en;

/** A text that may be missing: of a status or a kind that only the app knows. @param {string} key @param {string} other */
export const tOr = (key, other) => (has(key) ? t(key) : other);

/** What the station says, in the language of who reads it. @param {Words} words */
export function say({ key, facts, text }) {
  const own = `said.${key}`;
  return has(own) ? t(own, facts) : text;
}
