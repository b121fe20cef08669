// Parts of the tools that put many trips at once: which action, and between which corners.

import { h } from "preact";
import { capital } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { read } from "../core/typed.js";
import { drawn, pattern, tool } from "./state.js";

/** @import { Tool } from "./state.js" */

export const MOST = 500; // trips at once

/** @typedef {{ from: At, to: At }} Corners */

/** The middle third of the map, until something is drawn. @returns {Corners} */
function somewhere() {
  const [width, height] = app.value?.map.size ?? [1, 1];
  const at = (/** @type {number} */ share) => ({ x: Number((width * share).toFixed(1)), y: Number((height * share).toFixed(1)) });
  return { from: at(1 / 3), to: at(2 / 3) };
}

export const corners = () => drawn.value ?? somewhere();

/** Let a tool work, or none. @param {Tool | null} next */
export function work(next) {
  drawn.value = null;
  pattern.value = [];
  tool.value = next;
}

/** What can be put many times: no items, which are picked one by one, unless there is nothing else. */
export function plainAction() {
  const { actions = [] } = app.value ?? {};
  return (actions.find(({ item }) => !item) ?? actions[0])?.name ?? "";
}

/** @param {{ value: string, onPick: (name: string) => void }} props */
export const ActionChoice = ({ value, onPick }) => h("label", { class: "field" },
  h("span", { class: "hint" }, t("trips.action")), h("select", {
    class: "input", value,
    onChange: (/** @type {Event} */ event) => onPick(/** @type {HTMLSelectElement} */ (event.currentTarget).value),
  }, app.value?.actions.map(({ name }) => h("option", { key: name, value: name }, capital(name)))));

/** The corners, to be written. */
export function CornerFields() {
  const shape = corners();
  /** @param {"from" | "to"} end @param {"x" | "y"} axis */
  const coordinate = (end, axis) => h("input", {
    class: "input", inputMode: "decimal", autocomplete: "off", "aria-label": t(`trips.${end}-${axis}`), value: shape[end][axis],
    onChange: (/** @type {Event} */ event) => {
      const value = read({ name: axis, type: "float" }, /** @type {HTMLInputElement} */ (event.currentTarget).value);
      if (typeof value === "number") drawn.value = { ...shape, [end]: { ...shape[end], [axis]: value } };
    },
  });
  return h("div", { class: "corners" },
    h("span", { class: "hint" }, t("trips.from")), coordinate("from", "x"), coordinate("from", "y"),
    h("span", { class: "hint" }, t("trips.to")), coordinate("to", "x"), coordinate("to", "y"));
}

/** A field of a tool. @param {{ label: string, value: string, numeric?: boolean, onWrite: (text: string) => void }} props */
export const ToolField = ({ label, value, numeric = true, onWrite }) => h("label", { class: "field" },
  h("span", { class: "hint" }, label), h("input", {
    class: "input", inputMode: numeric ? "numeric" : undefined, autocomplete: "off", value,
    onInput: (/** @type {Event} */ event) => onWrite(/** @type {HTMLInputElement} */ (event.currentTarget).value),
  }));
