// Drawing in the plan so that it can be taken back: by Undo beside what was done, and step by step.

import { between, reverting, touched } from "./difference.js";
import { t } from "./i18n.js";
import { speakOut, tell } from "./notices.js";
import { plan, selectKey, undo } from "./station.js";

/** @import { Change } from "./changes.js" */
/** @import { Difference } from "./difference.js" */

/** Select what a difference is about, as far as it is still there. @param {Difference} difference */
function show(difference) {
  const { mission, trip } = touched(difference);
  const found = plan.missions.peek().find(({ key }) => key === mission);
  if (found) selectKey(found.key, found.trips.some(({ key }) => key === trip) ? trip : null);
}

/** Take the last step back, or do it again. @param {"undo" | "redo"} way */
export function step(way) {
  const done = undo.step(plan.missions.peek(), (change) => plan.make(change), way);
  if (!done) {
    tell(t(way === "undo" ? "undo.nothing" : "redo.nothing"));
    return;
  }
  show(done);
  speakOut(t(way === "undo" ? "undo.done" : "redo.done"));
}

/** Change the plan, and offer to take just that back. @param {Change} change @param {string} said what is done */
export function drawTelling(change, said) {
  const before = plan.missions.peek();
  plan.edit(change);
  tellUndoable(before, said);
}

/** Offer to take back all that has changed since. @param {ReturnType<typeof plan.missions.peek>} before @param {string} said */
export function tellUndoable(before, said) {
  const difference = between(before, plan.missions.peek());
  const last = undo.done.peek().at(-1);
  tell(said, {
    settles: true,
    undo: difference && (() => {
      if (undo.done.peek().at(-1) === last) step("undo");
      else {
        plan.edit(reverting(difference));
        show(difference);
      }
    }),
  });
}
