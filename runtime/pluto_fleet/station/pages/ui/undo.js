// Undo and redo, as buttons and by their keys, on the pages on which a plan is drawn.

import { h } from "preact";
import { useEffect } from "preact/hooks";
import { step } from "../core/drawing.js";
import { t } from "../core/i18n.js";
import { undo } from "../core/station.js";
import { IconButton } from "./button.js";

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
