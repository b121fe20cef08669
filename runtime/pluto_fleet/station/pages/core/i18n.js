// All texts of the pages, in the language of who reads them: texts/en.js is the catalogue, and those
// of other languages have the same keys, which the type checker holds. Only the chosen one is loaded.

import { batch, signal } from "@preact/signals";

/** @typedef {keyof typeof import("../texts/en.js").default} TextKey */
/** @typedef {string | { one: string, other: string }} Text a text, or its two numbers, by the fact n */
/** @typedef {Record<TextKey, Text>} Catalogue */
/** @typedef {Record<string, unknown>} Facts */

/** The languages, as each calls itself. */
export const LANGUAGES = { en: "English", it: "Italiano", de: "Deutsch" };
/** @typedef {keyof typeof LANGUAGES} Language */

/** @type {Record<Language, () => Promise<{ default: Catalogue }>>} */
const LOADERS = {
  en: () => import("../texts/en.js"),
  it: () => import("../texts/it.js"),
  de: () => import("../texts/de.js"),
};

export const language = signal(/** @type {Language} */ ("en"));
/** The place whose decimals and dates are written: that of the browser, where it speaks our language. */
export const locale = signal("en-GB");
const texts = signal(/** @type {Partial<Catalogue>} */ ({}));

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
  const { default: loaded } = await LOADERS[next]();
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

/** A text in the language of who reads it; its key where no language could be loaded. @param {TextKey} key @param {Facts} [facts] */
export const t = (key, facts = {}) => filled(texts.value[key] ?? key, facts);

/** Whether the catalogue has a text. @param {string} key @returns {key is TextKey} */
export const has = (key) => Object.hasOwn(texts.value, key);

/** A text that may be missing: of a status or a kind that only the app knows. @param {string} key @param {string} other */
export const tOr = (key, other) => (has(key) ? t(key) : other);
