// Drawing over the ground, to select pins or to put many trips at once: a row, a grid, or the sweep of an area in
// lanes around what may not be flown over, which the station computes; seen before they are added.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { send } from "../core/api.js";
import { capital, duration, many, number, percent, t } from "../core/i18n.js";
import { landmarks } from "../core/landmarks.js";
import { app } from "../core/station.js";
import { read } from "../ui/field.js";
import { useAnswer } from "../ui/hooks.js";
import { Button, IconButton, Input, Select } from "../ui/parts.js";
import { add } from "./commands.js";
import { take } from "./palette.js";
import { grid, rounded, row } from "./snapping.js";
import { abouts, drawn, markAll, marked, pattern, tool } from "./state.js";

/** @import { Tool } from "./state.js" */

/** @param {At} at @returns {At} */
const onGrid = ({ x, y }) => ({ x: rounded(x, 0.1), y: rounded(y, 0.1) });

/**
 * What is around the map: with a tool at work, or with Shift, a drag over the ground draws.
 * @param {{ camera: Camera, class?: string, onMove?: (event: PointerEvent) => void, children?: ComponentChildren }} props
 */
export function Drawing({ camera, class: more = "", onMove, children }) {
  const from = useRef(/** @type {At | null} */ (null));
  const isSelecting = useRef(false);

  /** @param {PointerEvent} event */
  function begin(event) {
    const target = /** @type {Element} */ (event.target);
    if (event.button || !camera.picture?.contains(target) || target.closest("[data-own]")) return;
    if (!tool.peek() && !event.shiftKey) return;
    event.stopPropagation(); // else the map is moved
    event.preventDefault();
    isSelecting.current = tool.peek() === null || tool.peek() === "area";
    from.current = camera.metres(event);
    /** @type {Element} */ (event.currentTarget).setPointerCapture(event.pointerId);
  }
  /** @param {PointerEvent} event */
  function move(event) {
    onMove?.(event);
    if (!from.current) return;
    const [start, now] = [from.current, camera.metres(event)];
    drawn.value = isSelecting.current ? { from: start, to: now } : { from: onGrid(start), to: onGrid(now) };
  }
  /** @param {PointerEvent} event */
  function end(event) {
    const start = from.current;
    from.current = null;
    if (!start || !isSelecting.current) return;
    drawn.value = null;
    tool.value = null;
    const now = camera.metres(event);
    const isIn = (/** @type {number} */ value, /** @type {number} */ a, /** @type {number} */ b) => value >= Math.min(a, b) && value <= Math.max(a, b);
    const inside = abouts.peek().filter(({ target }) =>
      target && isIn(target[0], start.x, now.x) && isIn(target[1], start.y, now.y)).map(({ key }) => key);
    const kept = event.ctrlKey || event.metaKey ? marked.peek().filter((key) => !inside.includes(key)) : [];
    markAll([...kept, ...inside]);
  }
  return h("div", {
    class: more, onPointerDownCapture: begin, onPointerMove: move, onPointerUp: end,
    onPointerCancel: () => { from.current = null; },
  }, children);
}

/** What is being drawn, in metres. */
export function Drawn() {
  const now = drawn.value;
  if (!now) return null;
  const { from, to } = now;
  if (tool.value === "row") return h("line", { class: "drawn", x1: from.x, y1: from.y, x2: to.x, y2: to.y });
  return h("rect", {
    class: "drawn", x: Math.min(from.x, to.x), y: Math.min(from.y, to.y),
    width: Math.abs(to.x - from.x), height: Math.abs(to.y - from.y),
  });
}

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
  h({ row: Row, grid: Grid, sweep: Sweep }[now], { action }),
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
  useEffect(() => { pattern.value = total > MOST ? [] : stops(row(from, to, total)); }, [from.x, from.y, to.x, to.y, total]);
  return h(Counts, { total }, h(ToolField, { label: t("page.trips"), value: trips, onWrite: setTrips }));
}

function Grid() {
  const [columns, setColumns] = useState("4");
  const [rows, setRows] = useState("3");
  const { from, to } = corners();
  const [wide, high] = [count(columns), count(rows)];
  useEffect(() => { pattern.value = wide * high > MOST ? [] : stops(grid(from, to, wide, high)); }, [from.x, from.y, to.x, to.y, wide, high]);
  return h(Counts, { total: wide * high },
    h(ToolField, { label: t("trips.columns"), value: columns, onWrite: setColumns }),
    h(ToolField, { label: t("trips.rows"), value: rows, onWrite: setRows }));
}

export const MOST = 500; // trips at once

/** @param {readonly Point[]} targets */
const stops = (targets) => targets.map((target) => ({ target }));

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
  h("span", { class: "hint" }, t("trips.action")), h(Select, {
    value, onPick, options: (app.value?.actions ?? []).map(({ name }) => [name, capital(name)]),
  }));

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
  h("span", { class: "hint" }, label), h(Input, { inputMode: numeric ? "numeric" : undefined, autocomplete: "off", value, onText: onWrite }));

const LEAST_TOLD = 0.5; // metres of way that are not over the area, as of commands
const PAUSE = 250; // ms until what is being drawn is asked for

/** @param {Corners} corners @returns {Point[]} */
const rectangle = ({ from, to }) => [[from.x, from.y], [to.x, from.y], [to.x, to.y], [from.x, to.y]];

/** A place without the height at which drones cruise anyway. @param {Point} target @returns {Point} */
const flat = ([x, y, z]) => (z === undefined || z === app.peek()?.map.cruise_height ? [x, y] : [x, y, z]);

/** @param {object} area @returns {Promise<Swept>} */
async function sweep(area) {
  const before = abouts.peek().at(-1)?.target ?? undefined;
  return (await send("POST", "/api/plan/sweep", { ...area, before })).data;
}

/** What lies between lanes, or what photos have in common. @param {string} text */
const dense = (text) => (text.trim().endsWith("%") ? { overlap: text } : { spacing: text });

/** Whether an action can be done on the way, again and again. @param {string} action */
const canOnTheWay = (action) =>
  app.value?.fields.trip.some(({ type, spaced = [] }) => type === "along" && spaced.includes(action)) ?? false;

/** @param {{ action: string }} props */
function Sweep({ action }) {
  const [spacing, setSpacing] = useState("1 m");
  const [isOnTheWay, goOn] = useState(false);
  const [zone, setZone] = useState("");
  const zones = landmarks.value?.zones ?? [];
  const polygon = zones.find(({ name }) => name === zone)?.corners ?? rectangle(corners());
  const can = canOnTheWay(action);
  const area = { polygon, ...dense(spacing), action, on_the_way: can && isOnTheWay };
  const { data, trouble } = useAnswer([], () => sweep(area), { anew: JSON.stringify(area), settles: PAUSE });
  const isTooMany = data !== null && data.trips.length > MOST;
  const swept = isTooMany ? null : data;
  useEffect(() => { pattern.value = swept?.trips.map((trip) => ({ ...trip, target: flat(trip.target), source: trip.source && flat(trip.source) })) ?? []; }, [swept]);
  const wrong = isTooMany ? t("trips.count-wrong", { n: MOST }) : trouble;
  return h("div", { class: "stack" },
    zones.length > 0 && h("label", { class: "field" }, h("span", { class: "hint" }, t("trips.zone")), h(Select, {
      value: zone, onPick: setZone, options: [["", t("trips.zone-drawn")], ...zones.map(({ name }) => [name, name])],
    })),
    !zone && h(CornerFields, null),
    h(ToolField, { label: t("trips.spacing"), value: spacing, numeric: false, onWrite: setSpacing }),
    can && h("label", { class: "field" }, h("span", { class: "hint" }, t("trips.swept-where")), h(Select, {
      value: isOnTheWay ? "lines" : "", onPick: (picked) => goOn(picked === "lines"), options: [["", t("trips.at-each-place")], ["lines", t("trips.on-the-way")]],
    })),
    swept && h("p", { class: "hint" }, t("trips.swept", { trips: many("many.trips", swept.trips.length), places: many("many.places", swept.places), metres: number(swept.metres) })),
    swept && swept.outside >= LEAST_TOLD && h("p", { class: "hint" }, t("trips.swept-outside", { metres: number(swept.outside) })),
    swept?.seconds && h("p", { class: "hint" }, t("trips.swept-takes", { time: duration(swept.seconds) })),
    swept && swept.forbidden > 0 && h("p", { class: "hint" }, t("trips.swept-forbidden", { share: percent(swept.forbidden) })),
    wrong && h("p", { class: "problem", role: "status" }, wrong));
}
