// Undo and redo of all that this page has drawn. What differs between two states of the plan is taken back
// though others have drawn meanwhile: only what is still as it was left is reverted. Letters typed one after
// another are one step. Kept by the browser over a reload.

import { batch, signal } from "@preact/signals";
import { leaves } from "./changes.js";

/** @typedef {{ key: string, [field: string]: unknown }} Keyed */
/** What a plan was and has become; of missions and trips in which nothing differs only the keys. @typedef {{ before: Keyed[], after: Keyed[] }} Difference */

const STATIONS_OWN = ["launched", "ended"]; // pages do not set them

/** @param {unknown} value @returns {value is Record<string, unknown>} */
const isThing = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** @param {unknown} value @returns {value is Keyed[]} */
const isKeyed = (value) => Array.isArray(value) && value.every((one) => isThing(one) && typeof one.key === "string");

/** @param {unknown} value @returns {unknown} the same with its fields in order, so that its text is one */
const inOrder = (value) => {
  if (Array.isArray(value)) return value.map(inOrder);
  if (!isThing(value)) return value;
  const names = Object.keys(value).filter((name) => value[name] !== undefined && !STATIONS_OWN.includes(name)).sort();
  return Object.fromEntries(names.map((name) => [name, inOrder(value[name])]));
};

/** @param {unknown} one @param {unknown} other */
export const isSame = (one, other) => one === other || JSON.stringify(inOrder(one)) === JSON.stringify(inOrder(other));

/** What differs; null: nothing. @param {PlanMission[]} before @param {PlanMission[]} after @returns {Difference | null} */
export function between(before, after) {
  if (isSame(before, after)) return null;
  return { before: differing(before, after), after: differing(after, before) };
}

/** Of missions and of their trips that have stayed as they are only the keys. @param {readonly Keyed[]} all @param {readonly Keyed[]} others @returns {Keyed[]} */
function differing(all, others) {
  const by = byKey(others);
  return all.map((one) => {
    const other = by.get(one.key);
    if (isSame(one, other)) return { key: one.key };
    return isKeyed(one.trips) && isKeyed(other?.trips) ? { ...one, trips: differing(one.trips, other.trips) } : one;
  });
}

/** @template {{ key: string }} Item @param {readonly Item[]} items */
const byKey = (items) => new Map(items.map((one) => [one.key, one]));

/** `now` as it was before a step, but for what another one has changed since. @param {unknown} before @param {unknown} after @param {unknown} now @returns {unknown} */
function reverted(before, after, now) {
  if (isSame(before, after)) return now;
  const all = [before, after, now];
  if (isKeyed(before) && isKeyed(after) && isKeyed(now)) return revertedList(before, after, now);
  const isPlace = all.every((one) => Array.isArray(one) && one.length === /** @type {any} */ (now).length);
  if (!isPlace && !all.every(isThing)) return isSame(now, after) ? before : now;
  const [old, fresh, present] = /** @type {Record<string, unknown>[]} */ (all);
  if (isPlace) return /** @type {any} */ (now).map((/** @type {unknown} */ one, /** @type {number} */ at) => reverted(old[at], fresh[at], one));
  const found = { ...present };
  for (const name of Object.keys({ ...old, ...fresh }).filter((one) => !STATIONS_OWN.includes(one))) {
    found[name] = reverted(old[name], fresh[name], present[name]);
    if (found[name] === undefined) delete found[name];
  }
  return found;
}

/** @param {Keyed[]} before @param {Keyed[]} after @param {Keyed[]} now */
function revertedList(before, after, now) {
  const [was, is] = [byKey(before), byKey(after)];
  let items = now
    .filter((one) => one.launched || was.has(one.key) || !isSame(one, is.get(one.key)))
    .map((one) => {
      const [old, fresh] = [was.get(one.key), is.get(one.key)];
      if (!old || !fresh) return one;
      if (one.launched) return { ...one, trips: reverted(old.trips, fresh.trips, one.trips) }; // no more of it can be changed
      return /** @type {Keyed} */ (reverted(old, fresh, one));
    });
  const here = byKey(items);
  const inBoth = (/** @type {Keyed[]} */ all) => all.map(({ key }) => key).filter((key) => was.has(key) && is.has(key) && here.has(key));
  if (isSame(inBoth(items), inBoth(after))) { // their order is unchanged since
    const next = inBoth(before).values();
    items = items.map((one) => (was.has(one.key) && is.has(one.key) ? here.get(next.next().value ?? "") ?? one : one));
  }
  before.forEach((item, at) => {
    if (is.has(item.key) || here.has(item.key)) return;
    const earlier = before.slice(0, at).map(({ key }) => key);
    items = items.toSpliced(items.findLastIndex(({ key }) => earlier.includes(key)) + 1, 0, item);
  });
  return items;
}

/** Take a difference back, as a change of the plan. @param {Difference} difference @returns {Change} */
export const reverting = ({ before, after }) => (missions) =>
  /** @type {PlanMission[]} */ (reverted(before, after, missions));

/** Where the values stand that a difference has set. @param {Difference} difference */
function places({ before, after }) {
  const [was, is] = [before, after].map((missions) => leaves(/** @type {PlanMission[]} */ (missions)));
  return [...new Set([...was.keys(), ...is.keys()])].filter((at) => was.get(at) !== is.get(at));
}

/** The mission and the trip that a difference touches first. @param {Difference} difference */
export function touched(difference) {
  const [mission = null, trip = null] = places(difference)[0]?.split(" ") ?? [];
  return { mission, trip };
}

const MOST = 200; // steps
const PAUSE = 2500; // ms after which typing is another step

/** @typedef {{ difference: Difference, typing: boolean, at: number }} Step */

/** The steps that this page can take back, and those that it can do again. */
export class Undo {
  /** @param {() => number} now ms */
  constructor(now = () => performance.now()) {
    this.now = now;
    /** @type {Signal<Step[]>} */
    this.done = signal([]);
    /** @type {Signal<Step[]>} */
    this.undone = signal([]);
  }

  /** Remember what was drawn. @param {PlanMission[]} before @param {PlanMission[]} after @param {boolean} [typing] */
  record(before, after, typing = false) {
    const difference = between(before, after);
    if (!difference) return;
    const at = this.now();
    const last = this.done.peek().at(-1);
    const goesOn = last?.typing && at - last.at < PAUSE && isSame(places(last.difference), places(difference));
    const whole = goesOn ? { before: last.difference.before, after: difference.after } : difference;
    batch(() => {
      this.done.value = [...this.done.peek().slice(0, goesOn ? -1 : undefined), { difference: whole, typing, at }].slice(-MOST);
      this.undone.value = [];
    });
  }

  /**
   * Take the last step back, or do it again. Steps of which others have left nothing are passed over.
   * @param {PlanMission[]} missions as they are @param {(change: Change) => PlanMission[]} edit returns them as they are then
   * @param {"undo" | "redo"} way
   * @returns {Difference | null} what was done; null: there was nothing to do
   */
  step(missions, edit, way) {
    const [from, to] = way === "undo" ? [this.done, this.undone] : [this.undone, this.done];
    for (let steps = from.peek(); steps.length;) {
      const { difference } = steps[steps.length - 1];
      steps = steps.slice(0, -1);
      from.value = steps;
      const change = reverting(difference);
      if (isSame(change(missions), missions)) continue;
      const opposite = between(missions, edit(change));
      if (!opposite) continue;
      to.value = [...to.peek(), { difference: opposite, typing: false, at: this.now() }].slice(-MOST);
      return opposite;
    }
    return null;
  }

  /** As text, to be kept. */
  kept() {
    return JSON.stringify({ done: this.done.value, undone: this.undone.value });
  }

  /** @param {string} text */
  restore(text) {
    const { done, undone } = JSON.parse(text);
    const old = (/** @type {Step} */ one) => ({ ...one, typing: false });
    batch(() => {
      this.done.value = done.map(old);
      this.undone.value = undone.map(old);
    });
  }
}
