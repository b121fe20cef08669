// Many trips at once: a row, a grid, or the sweep of an area, seen before it is added.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { many } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { read } from "../core/typed.js";
import { Button, IconButton } from "../ui/button.js";
import { add } from "./commands.js";
import { take } from "./palette.js";
import { grid, row } from "./patterns.js";
import { pattern, tool } from "./state.js";
import { Sweep } from "./sweep.js";
import { ActionChoice, CornerFields, corners, MOST, plainAction, ToolField, work } from "./tool_parts.js";

const TOOLS = /** @type {const} */ ([["area", "select"], ["row", "row"], ["grid", "grid"], ["sweep", "sweep"]]);

/** The buttons of the tools. */
export const ToolButtons = () => h("span", { class: "tool-buttons", role: "group", "aria-label": t("trips.tools") },
  TOOLS.map(([name, icon]) => h(IconButton, {
    key: name, icon, label: t(`trips.tool.${name}`), pressed: tool.value === name,
    onClick: () => {
      const next = tool.peek() === name ? null : name;
      take(null);
      work(next);
    },
  })));

/** The tool at work, with what it would add. @param {{ onAdded: () => void }} props */
export function ToolPanel({ onAdded }) {
  const [action, setAction] = useState(plainAction);
  const now = tool.value;
  if (now === null || now === "area") return null;
  const total = pattern.value.length;
  /** @param {SubmitEvent} event */
  function submit(event) {
    event.preventDefault();
    const found = app.peek()?.actions.find(({ name }) => name === action);
    if (!found || !total) return;
    add(found, pattern.peek());
    work(null);
    onAdded();
  }
  return h("form", {
    class: "tool-panel card stack", "aria-label": t(`trips.tool.${now}`), onSubmit: submit,
    onKeyDown: (/** @type {KeyboardEvent} */ event) => { if (event.key === "Escape") work(null); },
  },
  h("p", { class: "hint" }, t(`trips.draw-${now}`)), h(ActionChoice, { value: action, onPick: setAction }),
  h({ row: Row, grid: Grid, sweep: Sweep }[now], null),
  h("div", { class: "row" },
    h(Button, { kind: "primary", type: "submit", disabled: !total }, t("trips.add-many", { trips: many("many.trips", total) })),
    h(Button, { kind: "quiet", onClick: () => work(null) }, t("trips.cancel"))));
}

/** @param {string} text */
function count(text) {
  const value = read({ name: "", type: "int" }, text);
  return typeof value === "number" && Number.isInteger(value) && value > 0 ? value : 0;
}

/** @param {{ total: number, children?: ComponentChildren }} props */
const Counts = ({ total, children }) => h("div", { class: "stack" }, h(CornerFields, null), h("div", { class: "counts" }, children),
  (total < 1 || total > MOST) && h("p", { class: "problem" }, t("trips.count-wrong", { n: MOST })));

function Row() {
  const [trips, setTrips] = useState("5");
  const { from, to } = corners();
  const total = count(trips);
  useEffect(() => { pattern.value = total > MOST ? [] : row(from, to, total); }, [from.x, from.y, to.x, to.y, total]);
  return h(Counts, { total }, h(ToolField, { label: t("trips.trips"), value: trips, onWrite: setTrips }));
}

function Grid() {
  const [columns, setColumns] = useState("4");
  const [rows, setRows] = useState("3");
  const { from, to } = corners();
  const [wide, high] = [count(columns), count(rows)];
  useEffect(() => { pattern.value = wide * high > MOST ? [] : grid(from, to, wide, high); }, [from.x, from.y, to.x, to.y, wide, high]);
  return h(Counts, { total: wide * high },
    h(ToolField, { label: t("trips.columns"), value: columns, onWrite: setColumns }),
    h(ToolField, { label: t("trips.rows"), value: rows, onWrite: setRows }));
}
