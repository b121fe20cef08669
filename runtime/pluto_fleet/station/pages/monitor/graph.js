// The app's own graph as boxes and arrows, with a number for each mission at the block where it is.

import { computed, effect, signal, useSignal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useId, useMemo, useRef } from "preact/hooks";
import { many } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app, selection, selectMission } from "../core/station.js";
import { toneOf } from "../ui/standing.js";
import { blocksOf, leftWith, wayFinder } from "./graph_way.js";

/** @import { AppShape, BlockShape, EdgeShape, GraphShape } from "../app" */
/** @import { MissionRow } from "../wire" */
/** @import { World } from "../core/world.js" */

const LIT = 2500; // ms that an edge stays lit after a mission took it
const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 20; // pixels of a token
const CORNER = 8; // pixels by which a bend is rounded

/** A line with rounded bends. @param {readonly (readonly number[])[]} points */
function path(points) {
  /** @param {readonly number[]} from @param {readonly number[]} to */
  const near = ([x, y], [toX, toY]) => {
    const length = Math.hypot(toX - x, toY - y) || 1;
    const part = Math.min(CORNER, length / 2) / length;
    return `${x + (toX - x) * part} ${y + (toY - y) * part}`;
  };
  return points.map((point, i) => {
    if (!i) return `M${point.join(" ")}`;
    const next = points[i + 1];
    if (!next) return `L${point.join(" ")}`;
    return `L${near(point, points[i - 1])}Q${point.join(" ")} ${near(point, next)}`;
  }).join("");
}

/** @param {{ world: World }} props */
export function Graph({ world }) {
  const { graph } = /** @type {{ graph: GraphShape }} */ (/** @type {AppShape} */ (app.value));
  const room = useRef(/** @type {HTMLDivElement | null} */ (null));
  const read = useSignal(/** @type {BlockShape | null} */ (null));
  const scale = useSignal(1);
  const here = useMemo(() => computed(() => standing(graph, world.missions.all())), [graph, world]);
  const lit = useLit(graph, world);
  const id = useId();
  useEffect(() => {
    const measured = new ResizeObserver(([{ contentRect: { width } }]) => {
      if (width) scale.value = Math.max(0.35, Math.min(width / graph.width, 1.25));
    });
    measured.observe(/** @type {HTMLDivElement} */ (room.current));
    return () => measured.disconnect();
  }, [graph, scale]);
  const { value: block } = read;
  const names = block ? (here.value.get(block.name) ?? []).map(({ name }) => name) : [];
  return h("div", { class: "graph-view" },
    h("div", { ref: room, class: "graph-room", style: { height: `${graph.height * scale.value + 8}px` } },
      h("div", { class: "graph-stage", style: { transform: `scale(${scale.value})`, width: `${graph.width}px`, height: `${graph.height}px` } },
        h("svg", { width: graph.width, height: graph.height, "aria-hidden": true },
          h("defs", null, h("marker", {
            id, orient: "auto", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 8, markerHeight: 8, markerUnits: "userSpaceOnUse",
          }, h("path", { d: "M0 0L8 4L0 8z" }))),
          graph.edges.map((edge, at) => h(Edge, { key: at, edge, head: id, lit }))),
        graph.blocks.map((one) => h(Block, {
          key: one.name, block: one, rows: here.value.get(one.name) ?? [], onRead: (yes) => { read.value = yes ? one : null; },
        })))),
    h("p", { class: "caption" }, block
      ? [h("strong", null, block.name), ` ${block.doc} `, names.length > 0 && t("graph.here", { n: names.length, names })]
      : t("graph.hint")));
}

/** The missions at each block, by its name. @param {GraphShape} graph @param {MissionRow[]} rows */
function standing(graph, rows) {
  const known = new Set(graph.blocks.map(({ name }) => name));
  /** @type {Map<string, MissionRow[]>} */
  const here = new Map();
  for (const row of rows.toSorted((a, b) => a.index - b.index)) {
    for (const name of blocksOf(row, known)) here.set(name, [...here.get(name) ?? [], row]);
  }
  return here;
}

/** The edges that missions took a moment ago. @param {GraphShape} graph @param {World} world */
function useLit(graph, world) {
  const lit = useMemo(() => signal(/** @type {ReadonlySet<EdgeShape>} */ (new Set())), [graph]);
  useEffect(() => {
    const way = wayFinder(graph);
    const known = new Set(graph.blocks.map(({ name }) => name));
    /** @type {Map<string, MissionRow>} */
    const before = new Map();
    const timers = new Set();
    const stop = effect(() => {
      /** @type {EdgeShape[]} */
      const taken = [];
      for (const row of world.missions.all()) {
        const was = before.get(row.name);
        before.set(row.name, row);
        if (!was || was === row) continue;
        const from = blocksOf(was, known);
        for (const to of blocksOf(row, known)) {
          if (!from.includes(to)) taken.push(...way(from, leftWith(was, row), to, row.status));
        }
      }
      if (!taken.length) return;
      lit.value = new Set([...lit.peek(), ...taken]);
      const timer = setTimeout(() => {
        timers.delete(timer);
        lit.value = new Set([...lit.peek()].filter((edge) => !taken.includes(edge)));
      }, LIT);
      timers.add(timer);
    });
    return () => {
      stop();
      timers.forEach((timer) => clearTimeout(timer));
    };
  }, [graph, world, lit]);
  return lit;
}

/** @param {{ edge: EdgeShape, head: string, lit: import("@preact/signals").Signal<ReadonlySet<EdgeShape>> }} props */
const Edge = ({ edge, head, lit }) => h("g", { class: lit.value.has(edge) ? "lit" : "" },
  h("path", {
    class: `edge ${edge.fork ? "fork" : ""} ${edge.dotted ? "dotted" : ""}`, d: path(edge.points),
    "marker-end": `url(#${head})`,
  }),
  edge.label && h("text", { x: edge.label[0], y: edge.label[1], "text-anchor": "middle" },
    edge.statuses.join(", ").toLowerCase()));

/** @param {{ block: BlockShape, rows: MissionRow[], onRead: (yes: boolean) => void }} props */
function Block({ block, rows, onRead }) {
  const { name, kind, shape, doc, x, y, w, h: height } = block;
  const words = kind.replaceAll(/([a-z])([A-Z])/g, "$1 $2");
  const chosen = selection.value.mission;
  const seated = rows.slice(0, SEATS);
  const picked = rows.find((row) => row.name === chosen);
  if (picked && !seated.includes(picked)) seated[SEATS - 1] = picked;
  return h("div", { class: "graph-block", style: { transform: `translate(${x}px, ${y}px)`, width: `${w}px` } },
    h("button", {
      type: "button", class: `block ${shape}-block`, style: { width: `${w}px`, height: `${height}px` },
      "aria-label": t("graph.block", { name, doc, missions: many("many.missions", rows.length) }),
      onPointerEnter: () => onRead(true), onFocus: () => onRead(true), onClick: () => onRead(true),
      onPointerLeave: () => onRead(false), onBlur: () => onRead(false),
    }, h("b", null, name), kind && h("small", null, words)),
    h("span", { class: "tokens", "aria-hidden": true, style: { height: `${SIZE}px` } },
      seated.map((row) => h("span", {
        key: row.name, title: row.name, class: `token ${toneOf(row.status)} ${row === picked ? "picked" : ""}`,
        onClick: () => selectMission(row.name),
      }, row.index + 1)),
      rows.length > SEATS && h("span", { class: "token" }, `+${rows.length - SEATS}`)));
}
