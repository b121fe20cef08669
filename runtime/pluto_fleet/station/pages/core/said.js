// What the station says by a key and facts, in the language of who reads it. Pure, but for the texts.

import { duration, inWords, many, percent, plain } from "./format.js";
import { has, t } from "./i18n.js";

/** @import { TextKey } from "./i18n.js" */

/** @typedef {Words["facts"][string]} Fact */

const SHARES = ["battery", "has", "level", "needs", "supposed", "takes"];
const TIMES = ["ready_in", "seconds"];
const MASSES = ["mg", "g", "kg"];
/** @type {Record<string, "many.missions" | "many.drones" | "many.runs">} */
const COUNTED = { missions: "many.missions", drones: "many.drones", runs: "many.runs" };
const NAMED = 3; // of a list; the others are counted

/** @param {string} name @param {Fact} value */
function written(name, value) {
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
  /** @type {TextKey} so the type checker holds that the catalogue has all of them */
  const own = `said.${key}`;
  if (!has(own)) return text;
  const all = Object.entries(facts).map(([name, value]) => [name, written(name, value)]);
  return t(own, { n: numberOf(facts), ...Object.fromEntries(all) });
}
