// Many trips at once: a row, or a grid, drawn over the map or written, and seen before it is added.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { capital, many } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { read } from "../core/typed.js";
import { Button, IconButton } from "../ui/button.js";
import { add } from "./commands.js";
import { take } from "./palette.js";
import { grid, row } from "./patterns.js";
import { drawn, inHand, pattern, tool } from "./state.js";

/** @import { At } from "../map/view.js" */
/** @import { Tool } from "./state.js" */

const MOST = 500; // trips at once
const TOOLS = /** @type {const} */ ([["area", "select"], ["row", "row"], ["grid", "grid"]]);

/** @param {Tool | null} next */
function work(next) {
  take(null);
  drawn.value = null;
  tool.value = next;
}

/** The buttons of the tools. */
export const ToolButtons = () => h("span", { class: "tool-buttons", role: "group", "aria-label": t("trips.tools") },
  TOOLS.map(([name, icon]) => h(IconButton, {
    key: name, icon, label: t(`trips.tool.${name}`), pressed: tool.value === name,
    onClick: () => work(tool.peek() === name ? null : name),
  })));

/** The middle third of the map, until something is drawn. @param {readonly number[]} size @returns {{ from: At, to: At }} */
const somewhere = ([width, height]) => {
  const at = (/** @type {number} */ share) => ({ x: Number((width * share).toFixed(1)), y: Number((height * share).toFixed(1)) });
  return { from: at(1 / 3), to: at(2 / 3) };
};

/** @param {unknown} count */
const isCount = (count) => Number.isInteger(count) && /** @type {number} */ (count) > 0;

/** What the tool at work would add, to be changed and added. @param {{ onAdded: () => void }} props */
export function ToolPanel({ onAdded }) {
  const { actions = [], map } = app.value ?? {};
  const plain = actions.filter(({ item }) => !item);
  const [action, setAction] = useState(inHand.peek()?.name ?? plain[0]?.name ?? actions[0]?.name ?? "");
  const [counts, setCounts] = useState({ trips: "5", columns: "4", rows: "3" });
  const now = tool.value;
  const shape = drawn.value ?? (map && somewhere(map.size));
  const number = (/** @type {keyof typeof counts} */ name) => read({ name, type: "int" }, counts[name]);
  const [trips, columns, rows] = [number("trips"), number("columns"), number("rows")];
  const isRow = now === "row";
  const isSound = isRow ? isCount(trips) : isCount(columns) && isCount(rows);
  const total = isSound ? (isRow ? Number(trips) : Number(columns) * Number(rows)) : 0;
  const can = total > 0 && total <= MOST;
  const isAtWork = now === "row" || now === "grid";
  const key = JSON.stringify([now, shape, can && isAtWork, trips, columns, rows]);
  useEffect(() => {
    pattern.value = !can || !shape || !isAtWork ? [] : isRow
      ? row(shape.from, shape.to, Number(trips)) : grid(shape.from, shape.to, Number(columns), Number(rows));
    return () => { pattern.value = []; };
  }, [key]);
  if (!isAtWork || !shape) return null;

  /** @param {SubmitEvent} event */
  function submit(event) {
    event.preventDefault();
    const found = actions.find(({ name }) => name === action);
    if (!found || !can) return;
    add(found, pattern.peek());
    work(null);
    onAdded();
  }
  /** @param {"from" | "to"} end @param {"x" | "y"} axis */
  const coordinate = (end, axis) => h("input", {
    class: "input", inputMode: "decimal", autocomplete: "off", "aria-label": t(`trips.${end}-${axis}`), value: shape[end][axis],
    onChange: (/** @type {Event} */ event) => {
      const value = read({ name: axis, type: "float" }, /** @type {HTMLInputElement} */ (event.currentTarget).value);
      if (typeof value === "number") drawn.value = { ...shape, [end]: { ...shape[end], [axis]: value } };
    },
  });
  /** @param {keyof typeof counts} name */
  const count = (name) => h("label", { class: "field" }, h("span", { class: "hint" }, t(`trips.${name}`)), h("input", {
    class: "input", inputMode: "numeric", autocomplete: "off", value: counts[name],
    onInput: (/** @type {Event} */ event) => setCounts({ ...counts, [name]: /** @type {HTMLInputElement} */ (event.currentTarget).value }),
  }));
  return h("form", {
    class: "tool-panel card stack", "aria-label": t(`trips.tool.${now}`), onSubmit: submit,
    onKeyDown: (/** @type {KeyboardEvent} */ event) => { if (event.key === "Escape") work(null); },
  },
  h("p", { class: "hint" }, t(isRow ? "trips.draw-row" : "trips.draw-grid")),
  h("label", { class: "field" }, h("span", { class: "hint" }, t("trips.action")), h("select", {
    class: "input", value: action,
    onChange: (/** @type {Event} */ event) => setAction(/** @type {HTMLSelectElement} */ (event.currentTarget).value),
  }, actions.map(({ name }) => h("option", { key: name, value: name }, capital(name))))),
  h("div", { class: "corners" },
    h("span", { class: "hint" }, t("trips.from")), coordinate("from", "x"), coordinate("from", "y"),
    h("span", { class: "hint" }, t("trips.to")), coordinate("to", "x"), coordinate("to", "y")),
  h("div", { class: "counts" }, isRow ? count("trips") : [count("columns"), count("rows")]),
  !can && h("p", { class: "problem" }, t("trips.count-wrong", { n: MOST })),
  h("div", { class: "row" },
    h(Button, { kind: "primary", type: "submit", disabled: !can }, t("trips.add-many", { trips: many("many.trips", total) })),
    h(Button, { kind: "quiet", onClick: () => work(null) }, t("trips.cancel"))));
}
