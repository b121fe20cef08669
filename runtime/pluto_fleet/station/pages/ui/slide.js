// A slide that acts only at its end: for what must not be done by a slip of the hand.

import { h } from "preact";
import { useRef, useState } from "preact/hooks";
import { Icon } from "./parts.js";

const END = 0.95; // of the way

/**
 * @param {{ label: string, onEnd: () => void, disabled?: boolean }} props
 * By keyboard and screen reader it is a slider: the right arrow, pressed to its end, acts.
 */
export function Slide({ label, onEnd, disabled }) {
  const [at, setAt] = useState(0);
  const track = useRef(/** @type {HTMLDivElement | null} */ (null));
  const from = useRef(/** @type {number | null} */ (null));

  /** @param {number} value */
  function move(value) {
    const next = Math.min(1, Math.max(0, value));
    if (next < END) {
      setAt(next);
      return;
    }
    from.current = null;
    setAt(0);
    onEnd();
  }
  const width = () => Math.max(1, (track.current?.clientWidth ?? 0) - 44);
  const letGo = () => {
    from.current = null;
    setAt(0);
  };
  return h("div", { class: "slide", ref: track, style: { "--at": at } },
    h("span", { class: "slide-label", "aria-hidden": true }, label),
    h("button", {
      type: "button", class: "slide-thumb", role: "slider", disabled, "aria-label": label,
      "aria-valuemin": 0, "aria-valuemax": 100, "aria-valuenow": Math.round(at * 100),
      onPointerDown: (/** @type {PointerEvent} */ event) => {
        /** @type {HTMLElement} */ (event.currentTarget).setPointerCapture(event.pointerId);
        from.current = event.clientX;
      },
      onPointerMove: (/** @type {PointerEvent} */ event) => {
        if (from.current !== null) move((event.clientX - from.current) / width());
      },
      onPointerUp: letGo, onPointerCancel: letGo, onBlur: letGo,
      onKeyDown: (/** @type {KeyboardEvent} */ event) => {
        if (event.key === "ArrowRight" && !event.repeat) move(at + 0.2);
        else if (event.key === "ArrowLeft") move(at - 0.2);
        else return;
        event.preventDefault();
      },
    }, h(Icon, { name: "speed" })));
}
