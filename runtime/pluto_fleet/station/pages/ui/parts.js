// Small parts that all pages share.

import { h } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { language, t } from "../core/i18n.js";
import { isTranslated, say } from "../core/said.js";
import { IconButton } from "./button.js";
import { Icon } from "./icon.js";

/** @import { IconName } from "./icon.js" */

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

/**
 * A sentence of the station, which speaks English; isOwn: it is the page's after all.
 * @param {{ text: string, isOwn?: boolean, class?: string }} props
 */
export const Said = ({ text, isOwn = false, class: more }) =>
  h("span", { class: more, lang: isOwn || language.value === "en" ? undefined : "en" }, text);

/** What the station says by a key, in the reader's language where it can. @param {{ words: Words }} props */
export const SaidWords = ({ words }) => h(Said, { text: say(words), isOwn: isTranslated(words) });

/** Facts in one line. @param {ComponentChildren[]} facts */
export const joined = (facts) => facts.flatMap((fact, at) => (at ? [" · ", fact] : [fact]));

/** @param {{ children?: ComponentChildren }} props */
export const Empty = ({ children }) => h("p", { class: "empty muted" }, children);
