// For what cannot be undone: the first press asks in place, the second one does it.

import { h } from "preact";
import { useState } from "preact/hooks";

/**
 * @param {{ label: string, sure: string, onSure: () => void }} props sure: the question on the button
 * A double click, and a key that repeats, are one press.
 */
export function SureButton({ label, sure, onSure }) {
  const [isAsking, ask] = useState(false);
  return h("button", {
    type: "button", class: `button small ${isAsking ? "danger" : ""}`,
    onBlur: () => ask(false),
    onKeyDown: (/** @type {KeyboardEvent} */ event) => { if (event.repeat) event.preventDefault(); },
    onClick: (/** @type {MouseEvent} */ { detail }) => {
      if (detail > 1) return;
      if (isAsking) onSure();
      ask(!isAsking);
    },
  }, isAsking ? sure : label);
}
