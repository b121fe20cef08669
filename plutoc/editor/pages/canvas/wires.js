// The edges: a path each, and on its middle the statuses that pass.

import { h, keyed, set, status, svg } from "../dom.js";
import { edgeSaid } from "../operations.js";
import { START, app, keyOf, selection, takes, worst } from "../state.js";
import { apart, lanes, route } from "./routes.js";

const TONES = ["UNEXECUTED", "RUNNING", "STANDBY", "COMPLETED", "FAILED", "many", "none", "chosen"];
const BOTH = 4; // how far chips of two edges may be apart to be one upon the other

const heads = svg("defs", {}, TONES.map((tone) => svg("marker", {
  id: `head-${tone}`, viewBox: "0 0 10 10", refX: 8.5, refY: 5, markerWidth: 9, markerHeight: 9,
  orient: "auto-start-reverse", markerUnits: "userSpaceOnUse", "data-status": tone,
}, svg("path", { d: "M0.5 0.8L9.2 5L0.5 9.2z" }))));
const paths = svg("g");
export const chips = h("div", { class: "chips" });

// What the ends of the selected edge are led elsewhere by.
const handles = ["source", "target"].map((end) => h("span", {
  class: "handle", "data-end": end, hidden: true, title: `Drag to another block: the edge’s ${end}`,
}));
export const grips = h("div", { class: "chips" }, handles);
export const wires = svg("svg", { class: "wires", "aria-hidden": "true" }, heads, paths);

const parts = new Map(); // key → { path, hit, chip, edge, lane }
let byNode = new Map();

const toneOf = ({ statuses }) => (statuses.length === 1 ? statuses[0] : statuses.length ? "many" : "none");

export function drawWires() {
  const edges = app.view.edges.map((edge) => [keyOf(edge), edge]);
  const groups = keyed(paths, edges, ([key]) => key, ([key]) =>
    svg("g", { class: "edge", "data-edge": key }, svg("path", { class: "hit" }), svg("path", { class: "wire" })));
  const labels = keyed(chips, edges, ([key]) => key, ([key]) =>
    h("button", { type: "button", class: "chip", "data-edge": key, tabIndex: -1 }));
  const lane = lanes(app.view.edges, app.nodes);
  parts.clear();
  byNode = new Map();
  for (const [i, [key, edge]] of edges.entries()) {
    const [group, chip] = [groups.get(key), labels.get(key)];
    parts.set(key, { path: group.lastChild, hit: group.firstChild, chip, edge, lane: lane[i] });
    for (const name of [edge.source, edge.target]) {
      if (!byNode.has(name)) byNode.set(name, []);
      byNode.get(name).push(key);
    }
    set(group, "data-status", toneOf(edge));
    group.classList.toggle("implicit", Boolean(edge.implicit));
    group.classList.toggle("unknown", !edge.known);
    group.classList.toggle("fork", Boolean(edge.fork));
    set(group, "data-problem", worst(edge.problems ?? []));
    write(chip, edge);
  }
  moveWires();
  markEdges();
}

// Where on the lower edge of its block an edge begins.
const portOf = ({ when, otherwise, statuses }) => {
  if (when.length === 1) return when[0];
  return otherwise && statuses.length === 1 ? statuses[0] : "all";
};

function write(chip, edge) {
  const key = JSON.stringify([edge.statuses, edge.when, edge.otherwise, edge.known]);
  set(chip, "aria-label", `Edge from ${edgeSaid(edge)}`);
  set(chip, "data-problem", worst(edge.problems ?? []));
  if (chip.dataset.said === key) return;
  chip.dataset.said = key;
  const shown = edge.statuses.length ? edge.statuses : edge.when.length ? edge.when : takes(edge);
  const passing = new Set(edge.statuses);
  chip.replaceChildren(...shown.map((name) => status(name, {
    class: `status${passing.has(name) ? "" : " idle"}`,
  })));
  chip.title = edge.statuses.length || !edge.known
    ? edgeSaid(edge) : `${edge.source} to ${edge.target}: no mission comes along here yet`;
}

// All, or those of these blocks, while they are dragged.
export function moveWires(names = null) {
  const nodes = [...app.nodes.values()];
  const keys = names ? new Set([...names].flatMap((name) => byNode.get(name) ?? [])) : parts.keys();
  const moved = [...keys].map((key) => parts.get(key));
  for (const part of moved) {
    const { path, hit, chip, edge, lane } = part;
    const { d, middle, points } = route(
      app.nodes.get(edge.source), portOf(edge), app.nodes.get(edge.target), nodes, lane);
    path.setAttribute("d", d);
    hit.setAttribute("d", d);
    const tall = 18 * Math.max(1, chip.childElementCount) + BOTH;
    Object.assign(part, { middle, tall, ends: [points[0], points.at(-1)] });
  }
  if (!names) apart(moved);
  for (const { chip, middle: [x, y] } of moved) {
    chip.style.transform = `translate(-50%, -50%) translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }
  placeHandles();
}

function placeHandles() {
  const part = parts.get(selection.edge);
  handles.forEach((handle, i) => {
    const there = part && !part.edge.implicit && !(i === 0 && part.edge.source === START);
    handle.hidden = !there;
    if (!there) return;
    const [x, y] = part.ends[i];
    handle.style.transform = `translate(${x - 9}px, ${y - 9}px)`;
  });
}

export function markEdges() {
  for (const [key, { path, chip, edge }] of parts) {
    const chosen = selection.edge === key;
    const near = selection.blocks.has(edge.source) || selection.blocks.has(edge.target);
    path.parentNode.classList.toggle("chosen", chosen);
    path.parentNode.classList.toggle("near", near);
    chip.classList.toggle("chosen", chosen);
    set(chip, "aria-pressed", String(chosen));
  }
  placeHandles();
}

export const edgeAt = (element) => app.edges.get(element?.closest?.("[data-edge]")?.dataset.edge);
export const chipOf = (key) => parts.get(key)?.chip;
export const middleOf = (key) => parts.get(key)?.middle;

// Light a walk: of a problem, or of a mission.
export function lightEdges(keys) {
  for (const [key, { path }] of parts) path.parentNode.classList.toggle("lit", keys.has(key));
}
