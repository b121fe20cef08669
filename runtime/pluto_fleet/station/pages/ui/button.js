// Buttons: plain ones, those that only have a sign, and those that must be held down.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { t } from "../core/i18n.js";
import { Icon } from "./icon.js";

/** @import { IconName } from "./icon.js" */

/**
 * @typedef {object} ButtonProps
 * @property {"" | "primary" | "danger" | "quiet"} [kind]
 * @property {IconName} [icon]
 * @property {boolean} [small]
 * @property {string} [title]
 * @property {string} [label] its name, where that is longer than what it shows
 * @property {boolean} [disabled]
 * @property {string | null} [why] why it cannot be pressed: it can be reached, and says so
 * @property {(event: MouseEvent) => void} [onClick]
 * @property {"button" | "submit"} [type]
 * @property {string} [class]
 * @property {boolean} [pressed]
 * @property {boolean} [expanded]
 * @property {ComponentChildren} [children]
 */

/** @param {ButtonProps} props */
export function Button({
  kind = "", icon, small, title, label, disabled, why, onClick, type = "button", class: more = "", pressed,
  expanded, children,
}) {
  return h("button", {
    type, title, disabled, "aria-label": label, class: `button ${kind} ${small ? "small" : ""} ${more}`,
    "aria-disabled": why ? "true" : undefined, "aria-pressed": pressed, "aria-expanded": expanded,
    onClick: why ? undefined : onClick,
  }, icon && h(Icon, { name: icon }), children && h("span", null, children));
}

/** A button with a sign alone; its name is read out, and shown under the pointer. @param {Omit<ButtonProps, "children"> & { label: string }} props */
export function IconButton({ label, icon, kind = "quiet", class: more = "", pressed, expanded, disabled, onClick }) {
  return h("button", {
    type: "button", class: `button icon-only ${kind} ${more}`, title: label, "aria-label": label,
    "aria-pressed": pressed, "aria-expanded": expanded, disabled, onClick,
  }, icon && h(Icon, { name: icon }));
}

const HOLD = 800; // ms

/**
 * A button that acts when it was held down, by pointer or key; a short press does something harmless.
 * @param {ButtonProps & { onHold: () => void, onPress: () => void, label?: string }} props
 */
export function HoldButton({ kind = "primary", icon, why, onHold, onPress, class: more = "", children }) {
  const [isHeld, setHeld] = useState(false);
  const timer = useRef(0);
  const isDone = useRef(false);
  useEffect(() => () => clearTimeout(timer.current), []);

  function press() {
    if (why || timer.current) return;
    isDone.current = false;
    setHeld(true);
    timer.current = setTimeout(() => {
      isDone.current = true;
      timer.current = 0;
      setHeld(false);
      onHold();
    }, HOLD);
  }
  function release() {
    clearTimeout(timer.current);
    timer.current = 0;
    setHeld(false);
  }
  return h("button", {
    type: "button", class: `button hold ${kind} ${isHeld ? "held" : ""} ${more}`,
    "aria-disabled": why ? "true" : undefined, title: why || t("hold.title"),
    style: { "--hold": `${HOLD}ms` },
    onPointerDown: (/** @type {PointerEvent} */ event) => { if (!event.button) press(); },
    onPointerUp: release, onPointerLeave: release, onPointerCancel: release,
    onKeyDown: (/** @type {KeyboardEvent} */ event) => {
      if (event.key === "Enter") event.preventDefault(); // else it clicks before it is held
      if ([" ", "Enter"].includes(event.key) && !event.repeat) press();
    },
    onKeyUp: (/** @type {KeyboardEvent} */ event) => {
      const isPressed = event.key === "Enter" && !isDone.current;
      release();
      if (isPressed) onPress();
    },
    onBlur: release,
    onContextMenu: (/** @type {Event} */ event) => event.preventDefault(),
    onClick: () => { if (!isDone.current) onPress(); },
  }, icon && h(Icon, { name: icon }), h("span", null, children));
}
