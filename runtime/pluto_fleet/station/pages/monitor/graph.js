// The app's own graph as boxes and arrows, with a number for each mission at the block where it is.

import { computed, effect, signal, useSignal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useId, useMemo, useRef } from "preact/hooks";
import { many, t } from "../core/i18n.js";
import { app, selection, selectMission } from "../core/station.js";
import { toneOf } from "../ui/parts.js";
import { blocksOf, leftWith, wayFinder } from "./graph_way.js";
import { apart, HEIGHT, lanes, route, widthOf } from "./routes.js";

/** @import { Node } from "./routes.js" */

const LIT = 2500; // ms that an edge stays lit after a mission took it
const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 28; // pixels of a token
const LINE = 18; // pixels of a status beside an edge
const ROOM = 44; // pixels around the picture

/** The lines of the edges, with what they say where there is something to choose, and what they cover. @param {GraphShape} graph */
function drawn({ blocks, edges }) {
  const choices = Map.groupBy(edges, ({ source }) => source);
  const saying = edges.filter(({ source, statuses }) =>
    choices.get(source)?.some((other) => `${other.statuses}` !== `${statuses}`));
  const nodes = new Map(blocks.map((block) => [block.name, {
    ...block, terminal: !block.kind,
    emits: [...new Set(saying.flatMap(({ source, statuses }) => (source === block.name && statuses.length === 1 ? statuses : [])))],
  }]));
  const all = [...nodes.values()];
  const lane = lanes(edges, nodes);
  const ways = edges.map((edge, i) => {
    const words = saying.includes(edge) ? edge.statuses : [];
    const [source, target] = [edge.source, edge.target].map((name) => /** @type {Node} */ (nodes.get(name)));
    const way = route(source, words.length === 1 ? words[0] : "all", target, all, lane[i]);
    return { ...way, edge, words, tall: LINE * Math.max(1, words.length) };
  });
  apart(ways);
  const across = [...all.flatMap((one) => [one.x, one.x + widthOf(one)]), ...ways.flatMap(({ points }) => points.map(([x]) => x))];
  const [left, right] = [Math.min(...across) - ROOM, Math.max(...across) + ROOM];
  return { ways, left, width: right - left, height: Math.max(...all.map(({ y }) => y)) + HEIGHT + ROOM };
}

/** @param {{ world: World }} props */
export function Graph({ world }) {
  const { graph } = /** @type {{ graph: GraphShape }} */ (/** @type {AppShape} */ (app.value));
  const room = useRef(/** @type {HTMLDivElement | null} */ (null));
  const read = useSignal(/** @type {BlockShape | null} */ (null));
  const scale = useSignal(1);
  const here = useMemo(() => computed(() => standing(graph, world.missions.all())), [graph, world]);
  const { ways, left, width, height } = useMemo(() => drawn(graph), [graph]);
  const lit = useLit(graph, world);
  const id = useId();
  useEffect(() => {
    const measured = new ResizeObserver(([{ contentRect }]) => {
      if (contentRect.width) scale.value = Math.max(0.35, Math.min(contentRect.width / width, 1.25));
    });
    measured.observe(/** @type {HTMLDivElement} */ (room.current));
    return () => measured.disconnect();
  }, [width, scale]);
  const { value: block } = read;
  const names = block ? (here.value.get(block.name) ?? []).map(({ name }) => name) : [];
  return h("div", { class: "graph-view" },
    h("div", { ref: room, class: "graph-room", style: { height: `${height * scale.value + 8}px` } },
      h("div", { class: "graph-stage", style: { transform: `scale(${scale.value}) translate(${-left}px)` } },
        h("svg", { "aria-hidden": true },
          h("defs", null, h("marker", {
            id, orient: "auto", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 11, markerHeight: 11, markerUnits: "userSpaceOnUse",
          }, h("path", { d: "M0 0L8 4L0 8z" }))),
          ways.map((way, at) => h(Edge, { key: at, way, head: id, lit }))),
        graph.blocks.map((one) => h(Block, {
          key: one.name, block: one, doc: graph.kinds[one.kind ?? ""] ?? "", rows: here.value.get(one.name) ?? [], onRead: (yes) => { read.value = yes ? one : null; },
        })))),
    h("p", { class: "caption" }, block
      ? [h("strong", null, block.name), ` ${graph.kinds[block.kind ?? ""] ?? ""} `, names.length > 0 && t("graph.here", { n: names.length, names })]
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

/** @param {{ way: ReturnType<typeof drawn>["ways"][number], head: string, lit: Signal<ReadonlySet<EdgeShape>> }} props */
const Edge = ({ way: { d, edge, words, middle: [x, y] }, head, lit }) => h("g", { class: lit.value.has(edge) ? "lit" : "" },
  h("path", {
    class: `edge ${edge.fork ? "fork" : ""} ${edge.implicit || !edge.statuses.length ? "dotted" : ""}`, d,
    "marker-end": `url(#${head})`,
  }),
  h("text", { x, y: y + LINE * (0.8 - words.length / 2), "text-anchor": "middle" },
    words.map((word, i) => h("tspan", { key: word, x, dy: i && LINE }, word.toLowerCase()))));

/** @param {{ block: BlockShape, doc: string, rows: MissionRow[], onRead: (yes: boolean) => void }} props */
function Block({ block, doc, rows, onRead }) {
  const { name, kind = "", gate, x, y } = block;
  const words = kind.replaceAll(/([a-z])([A-Z])/g, "$1 $2");
  const width = `${widthOf({ terminal: !kind })}px`;
  const chosen = selection.value.mission;
  const seated = rows.slice(0, SEATS);
  const picked = rows.find((row) => row.name === chosen);
  if (picked && !seated.includes(picked)) seated[SEATS - 1] = picked;
  return h("div", { class: "graph-block", style: { transform: `translate(${x}px, ${y}px)`, width } },
    h("button", {
      type: "button", class: `block ${kind ? "" : "end-block"} ${gate ? "gate-block" : ""}`, style: { width, height: `${HEIGHT}px` },
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
