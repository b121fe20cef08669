// Undo and redo of all that this page has drawn. Others' changes stay; letters typed one after another
// are one step. Kept by the browser over a reload.

import { batch, signal } from "@preact/signals";
import { between, isSame, merged, reverting } from "./difference.js";

/** @import { Change } from "./changes.js" */
/** @import { Difference } from "./difference.js" */

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

  /**
   * Remember what was drawn.
   * @param {PlanMission[]} before @param {PlanMission[]} after @param {boolean} [typing]
   */
  record(before, after, typing = false) {
    const difference = between(before, after);
    if (!difference) return;
    const at = this.now();
    const last = this.done.peek().at(-1);
    const one = last?.typing && at - last.at < PAUSE ? merged(last.difference, difference) : null;
    const kept = one ? this.done.peek().slice(0, -1) : this.done.peek();
    batch(() => {
      this.done.value = [...kept, { difference: one ?? difference, typing, at }].slice(-MOST);
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
