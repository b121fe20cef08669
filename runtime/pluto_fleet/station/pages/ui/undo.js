// Drawing in the plan so that it can be taken back: by Undo beside what was done, and step by step, by buttons
// and keys, on the pages on which a plan is drawn.

import { h } from "preact";
import { useEffect } from "preact/hooks";
import { t } from "../core/i18n.js";
import { plan, selectKey, speakOut, tell, undo } from "../core/station.js";
import { between, reverting, touched } from "../core/undo.js";
import { IconButton } from "./parts.js";

/** @import { Difference } from "../core/undo.js" */

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

/** Whether letters were typed there since it was entered: then its own undo takes those back. */
let typedIn = /** @type {EventTarget | null} */ (null);
document.addEventListener("input", ({ target }) => { typedIn = target; });
document.addEventListener("focusin", () => { typedIn = null; });

/** @param {KeyboardEvent} event @returns {"undo" | "redo" | null} */
function wanted({ key, ctrlKey, metaKey, shiftKey, altKey }) {
  if (!(ctrlKey || metaKey) || altKey) return null;
  const letter = key.toLowerCase();
  if (letter === "z") return shiftKey ? "redo" : "undo";
  return letter === "y" ? "redo" : null;
}

/** Two buttons; as long as they are shown, their keys act, too. */
export function UndoButtons() {
  useEffect(() => {
    const onKey = (/** @type {KeyboardEvent} */ event) => {
      const way = wanted(event);
      if (!way || event.defaultPrevented) return;
      const { target } = event;
      if (target === typedIn && target instanceof HTMLInputElement && target.type === "text") return;
      event.preventDefault();
      step(way);
    };
    document.addEventListener("keydown", onKey);
    return () => document.removeEventListener("keydown", onKey);
  }, []);
  return h("span", { class: "undo-buttons", role: "group", "aria-label": t("undo.group") },
    h(IconButton, { icon: "undo", label: t("undo.last"), disabled: !undo.done.value.length, onClick: () => step("undo") }),
    h(IconButton, { icon: "redo", label: t("redo.last"), disabled: !undo.undone.value.length, onClick: () => step("redo") }));
}
