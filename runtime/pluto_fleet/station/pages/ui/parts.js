// Small parts that all pages share: signs, buttons, how things stand, a dialog, tabs, and sentences of the station.

import { h } from "preact";
import { useEffect, useId, useRef, useState } from "preact/hooks";
import { isTranslated, language, say, t, tOr } from "../core/i18n.js";

const PATHS = {
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  start: "M8 5l11 7-11 7z",
  home: "M4 11l8-7 8 7M6 10v10h12V10",
  land: "M12 4v11M7 11l5 5 5-5M5 20h14",
  warning: "M12 4L2.5 20h19zM12 10v5M12 17.4v.3",
  bad: "M12 3a9 9 0 110 18 9 9 0 010-18zM9 9l6 6M15 9l-6 6",
  info: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 11v6M12 7v.3",
  lock: "M6 11h12v9H6zM8.5 11V8a3.5 3.5 0 017 0v3",
  good: "M12 3a9 9 0 110 18 9 9 0 010-18zM8 12l3 3 5-6",
  wait: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 7v5l3 2",
  pause: "M9 5v14M15 5v14",
  grip: "M9 6v.1M15 6v.1M9 12v.1M15 12v.1M9 18v.1M15 18v.1",
  close: "M6 6l12 12M18 6L6 18",
  bell: "M6 17V11a6 6 0 0112 0v6l2 2H4zM10 20.5a2 2 0 004 0",
  undo: "M9 7L4 12l5 5M4 12h10a6 6 0 016 6v1",
  redo: "M15 7l5 5-5 5M20 12H10a6 6 0 00-6 6v1",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  rail: "M4 5h16v14H4zM15 5v14",
  fold: "M9 6l6 6-6 6",
  back: "M15 6l-6 6 6 6",
  next: "M7 6l7 6-7 6zM17 6v12",
  previous: "M17 6l-7 6 7 6zM7 6v12",
  more: "M5 12v.1M12 12v.1M19 12v.1",
  map: "M9 4L3 7v13l6-3 6 3 6-3V4l-6 3zM9 4v13M15 7v13",
  list: "M8 6h12M8 12h12M8 18h12M4 6v.1M4 12v.1M4 18v.1",
  pin: "M12 21s7-6.5 7-12a7 7 0 00-14 0c0 5.5 7 12 7 12zM12 11.5a2.5 2.5 0 100-5 2.5 2.5 0 000 5z",
  drone: "M9 9h6v6H9zM9 9L5 5M15 9l4-4M9 15l-4 4M15 15l4 4M5 5v.1M19 5v.1M5 19v.1M19 19v.1",
  chart: "M4 20V4M4 20h16M8 16v-4M12 16V8M16 16v-6",
  history: "M4 12a8 8 0 108-8 8 8 0 00-6 2.7L4 9M4 4v5h5M12 8v4l3 2",
  help: "M12 3a9 9 0 110 18 9 9 0 010-18zM9.5 9.5a2.5 2.5 0 113.5 2.300c-.7.3-1 .8-1 1.5M12 16.7v.3",
  settings: "M4 7h10M18 7h2M4 17h2M10 17h10M16 5v4M8 15v4",
  person: "M12 12a4 4 0 100-8 4 4 0 000 8zM4 21a8 8 0 0116 0",
  photo: "M4 7h4l2-3h4l2 3h4v12H4zM12 16.5a3.5 3.5 0 100-7 3.5 3.5 0 000 7z",
  save: "M12 4v11M7 11l5 5 5-5M5 20h14",
  select: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M9 9h6v6H9z",
  row: "M4 18.5v.1M9.500 14v.1M14.500 10v.1M20 5.500v.1",
  grid: "M5 5v.1M12 5v.1M19 5v.1M5 12v.1M12 12v.1M19 12v.1M5 19v.1M12 19v.1M19 19v.1",
  sweep: "M4 5h14v4.700H6v4.600h12v4.700H4",
  speed: "M5 5l7 7-7 7M13 5l7 7-7 7",
};
/** @typedef {keyof typeof PATHS} IconName */

/** @param {{ path: string, size?: number }} props */
const Sign = ({ path, size = 18 }) => h("svg", {
  class: "icon", viewBox: "0 0 24 24", width: size, height: size, fill: "none", stroke: "currentColor",
  "stroke-width": 2, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": true,
}, h("path", { d: path }));

/** @param {{ name: IconName, size?: number }} props */
export const Icon = ({ name, size }) => h(Sign, { path: PATHS[name], size });

/** @type {Record<string, string>} the signs of actions that every app knows */
const ACTIONS = {
  take_photo: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
  measure: "M10 4.5a2 2 0 014 0v9.2a4 4 0 11-4 0zM12 9v7.5",
  pick_item: "M5 15v5h14v-5M12 15V4M7 9l5-5 5 5",
  release_item: "M5 15v5h14v-5M12 4v11M7 10l5 5 5-5",
};
const STAR = "M12 4l2.3 5.2 5.7.6-4.2 3.9 1.2 5.6-5-2.9-5 2.9 1.2-5.6L4 9.8l5.7-.6z";

/** @param {{ action: string }} props */
export const ActionIcon = ({ action }) => h(Sign, { path: ACTIONS[action] ?? STAR });

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

/** A button with a sign alone; its name is read out, and shown under the pointer. @param {ButtonProps & { label: string }} props */
export const IconButton = ({ kind = "quiet", class: more = "", ...props }) =>
  h(Button, { ...props, kind, title: props.label, class: `icon-only ${more}` });

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

/** @type {Record<string, [IconName, "calm" | "busy" | "good" | "warn" | "bad"]>} */
const SIGNS = {
  UNEXECUTED: ["wait", "calm"], RUNNING: ["start", "busy"], STANDBY: ["wait", "calm"],
  COMPLETED: ["good", "good"], FAILED: ["bad", "bad"], PAUSED: ["pause", "warn"],
  CANCELLED: ["close", "calm"], UNCERTAIN: ["warning", "warn"], HELD: ["warning", "warn"],
  WAITING: ["wait", "calm"], EXECUTING: ["start", "busy"], SKIPPED: ["close", "calm"],
  FREE: ["good", "good"], LOW: ["wait", "calm"], BUSY: ["start", "busy"], RETURNING: ["home", "busy"],
  CHARGING: ["wait", "calm"], RECOVERING: ["wait", "warn"], LOST: ["warning", "bad"],
  OFFLINE: ["info", "calm"], LANDED: ["info", "calm"], ALOFT: ["warning", "warn"],
  UNKNOWN: ["warning", "warn"], RETIRED: ["close", "calm"],
};

/** @param {string} status */
export const toneOf = (status) => (SIGNS[status] ?? ["info", "calm"])[1];

/** @param {{ status: string }} props */
export function Standing({ status }) {
  const [name, tone] = SIGNS[status] ?? ["info", "calm"];
  return h("span", { class: `standing-word ${tone}`, "data-status": status },
    h(Icon, { name, size: 16 }), tOr(`status.${status}`, status));
}

/** @param {{ kind?: "" | "good" | "warn" | "bad" | "info", icon?: IconName, children?: ComponentChildren }} props */
export const Chip = ({ kind = "", icon, children }) =>
  h("span", { class: `chip ${kind}` }, icon && h(Icon, { name: icon, size: 14 }), children);

/** A battery as a bar and in percent; unknown is said to be. @param {{ level: number | null }} props */
export const Battery = ({ level }) => h("span", {
  class: `battery ${level === null ? "unknown" : level < 0.2 ? "bad" : level < 0.5 ? "warn" : ""}`,
}, h("span", { class: "battery-bar", "aria-hidden": true },
  h("span", { style: { width: `${Math.round((level ?? 0) * 100)}%` } })),
h("span", { class: "num" }, level === null ? t("unknown.short") : `${Math.round(level * 100)} %`));

/** @param {{ title: string, onClose: () => void, class?: string, children?: ComponentChildren, foot?: ComponentChildren }} props */
export function Dialog({ title, onClose, class: more = "", children, foot }) {
  const element = useRef(/** @type {HTMLDialogElement | null} */ (null));
  const id = useId();
  useEffect(() => {
    const { current } = element;
    const before = document.activeElement;
    current?.show(); // not modal: the Stops stay within reach
    current?.focus();
    return () => { if (before instanceof HTMLElement && before.isConnected) before.focus(); };
  }, []);
  return h("dialog", {
    ref: element, class: `dialog ${more}`, "aria-labelledby": id, tabIndex: -1,
    onKeyDown: (/** @type {KeyboardEvent} */ event) => {
      if (event.key !== "Escape") return;
      event.stopPropagation();
      onClose();
    },
  }, h("div", { class: "dialog-head" }, h("h2", { id }, title),
    h(IconButton, { icon: "close", label: t("close"), onClick: onClose })),
  h("div", { class: "dialog-body", tabIndex: 0 }, children),
  foot && h("div", { class: "dialog-foot" }, foot));
}

/**
 * A row of tabs over what they show.
 * @param {{ label: string, names: readonly string[], now: string, title: (name: any) => ComponentChildren, onPick: (name: any) => void, controls?: (name: string) => string }} props
 */
export function Tabs({ label, names, now, title, onPick, controls }) {
  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = names[(names.indexOf(now) + step + names.length) % names.length];
    onPick(next);
    const bar = /** @type {HTMLElement} */ (event.currentTarget);
    requestAnimationFrame(() => /** @type {HTMLElement | null} */ (bar.querySelector("[aria-selected=true]"))?.focus());
  }
  return h("div", { class: "tabs", role: "tablist", "aria-label": label, onKeyDown },
    names.map((name) => h("button", {
      type: "button", key: name, class: "tab", role: "tab", "aria-selected": name === now,
      "aria-controls": controls?.(name), tabIndex: name === now ? 0 : -1, onClick: () => onPick(name),
    }, title(name))));
}

/** A sentence of the station, which speaks English; isOwn: it is the page's after all. @param {{ text: string, isOwn?: boolean, class?: string }} props */
export const Said = ({ text, isOwn = false, class: more }) =>
  h("span", { class: more, lang: isOwn || language.value === "en" ? undefined : "en" }, text);

/** What the station says by a key, in the reader's language where it can. @param {{ words: Words }} props */
export const SaidWords = ({ words }) => h(Said, { text: say(words), isOwn: isTranslated(words) });

/** What is wrong, with its sign. @param {{ text: string, isOwn?: boolean, [more: string]: unknown }} props */
export const Problem = ({ text, isOwn, ...more }) =>
  h("p", { class: "problem", ...more }, h(Icon, { name: "warning" }), h(Said, { text, isOwn }));

/** @param {Event} event */
const inputOf = ({ currentTarget }) => /** @type {HTMLInputElement} */ (currentTarget);

/** A field that tells each letter. @param {{ onText: (text: string) => void, [more: string]: unknown }} props */
export const Input = ({ onText, ...more }) =>
  h("input", { class: "input", ...more, onInput: (/** @type {Event} */ event) => onText(inputOf(event).value) });

/** A box to tick before its words. @param {{ onTick: (yes: boolean) => void, children?: ComponentChildren, [more: string]: unknown }} props */
export const Check = ({ onTick, children, ...more }) => h("label", { class: "check" },
  h("input", { type: "checkbox", ...more, onChange: (/** @type {Event} */ event) => onTick(inputOf(event).checked) }), children);

/** Choices, each a value and its words. @param {{ options: readonly (readonly (string | number)[])[], onPick?: (value: any) => void, [more: string]: unknown }} props */
export const Select = ({ options, onPick, ...more }) => h("select", {
  class: "input", ...more, onChange: (/** @type {Event} */ event) => onPick?.(inputOf(event).value),
}, options.map(([value, words]) => h("option", { key: value, value }, words)));

/** Facts in one line. @param {ComponentChildren[]} facts */
export const joined = (facts) => facts.flatMap((fact, at) => (at ? [" · ", fact] : [fact]));

/** @param {{ children?: ComponentChildren }} props */
export const Empty = ({ children }) => h("p", { class: "empty muted" }, children);

/** A double click, and a key that repeats, are one press. @param {{ label: string, sure: string, onSure: () => void }} props sure: the question on the button */
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

/** Move the focus to the button before or after. @param {string} of a selector of the buttons @returns {(event: KeyboardEvent) => void} */
export const walking = (of) => (event) => {
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  const here = /** @type {Element} */ (event.target).closest(of);
  if (!step || !here) return;
  event.preventDefault();
  const all = [.../** @type {Element} */ (event.currentTarget).querySelectorAll(of)];
  const next = all[all.indexOf(here) + step];
  if (next instanceof HTMLElement) next.focus();
};
