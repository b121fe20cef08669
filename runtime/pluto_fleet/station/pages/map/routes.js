// The ways that drones take around walls, asked of the station, and remembered.

import { signal } from "@preact/signals";
import { ofStation, send } from "../core/api.js";

/** @typedef {readonly [Point, Point]} Pair */

const MOST = 500; // pairs in one question
const PAUSE = 150; // ms
const MOST_KEPT = 20_000;

/** The way of each pair that was asked for; null: there is none. @type {Map<string, Point[] | null>} */
const known = new Map();
/** Counts the answers, for those who draw. */
const version = signal(0);
/** @type {Map<string, Pair>} */
const wanted = new Map();
let timer = 0;

/** @param {Pair} pair */
const keyOf = ([from, to]) => `${from} ${to}`;

async function ask() {
  timer = 0;
  const asked = [...wanted].slice(0, MOST);
  for (const [key] of asked) wanted.delete(key);
  try {
    const { data } = await send("POST", "/api/ways", { ways: asked.map(([, pair]) => pair) });
    if (known.size > MOST_KEPT) known.clear();
    asked.forEach(([key], at) => known.set(key, data.ways[at]));
    version.value += 1;
  } catch (error) {
    const { status } = ofStation(error);
    if (status >= 400 && status < 429) { // it will never be known: straight, as before
      asked.forEach(([key, pair]) => known.set(key, [...pair]));
    }
  }
  if (wanted.size) later();
}

const later = () => { timer ||= setTimeout(ask, PAUSE); };

/** The way from one place to another; undefined: it is not known yet; null: there is none. @param {Pair} pair */
export function way(pair) {
  void version.value;
  const found = known.get(keyOf(pair));
  if (found === undefined) {
    wanted.set(keyOf(pair), pair);
    later();
  }
  return found;
}
