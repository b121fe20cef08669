// The edges: a path each, and on its middle the statuses that pass.

import { h, keyed, set, status, svg } from "../dom.js";
import { edgeSaid } from "../operations.js";
import { START, app, keyOf, selection, takes, worst } from "../state.js";
import { route } from "./routes.js";

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
  const ways = new Map();
  parts.clear();
  byNode = new Map();
  for (const [key, edge] of edges) {
    const [group, chip] = [groups.get(key), labels.get(key)];
    const lane = laneOf(edge, ways);
    parts.set(key, { path: group.lastChild, hit: group.firstChild, chip, edge, lane });
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

// Wires that would lie upon each other: between the same two blocks, or back into the same one.
function laneOf(edge, ways) {
  const [source, target] = [app.nodes.get(edge.source), app.nodes.get(edge.target)];
  const back = target.y - source.y < 72;
  const way = back ? `back ${edge.target}` : `${edge.source} ${edge.target}`;
  const lane = ways.get(way) ?? 0;
  ways.set(way, lane + 1);
  return lane;
}

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
  for (const key of keys) {
    const { path, hit, chip, edge, lane } = parts.get(key);
    const { d, middle: [x, y], ends } = route(
      app.nodes.get(edge.source), app.nodes.get(edge.target), edge, nodes, lane);
    path.setAttribute("d", d);
    hit.setAttribute("d", d);
    chip.style.transform = `translate(-50%, -50%) translate(${Math.round(x)}px, ${Math.round(y)}px)`;
    Object.assign(parts.get(key), { middle: [x, y], ends });
  }
  placeHandles();
  if (!names) apart();
}

// Chips that would cover each other are moved down a little.
function apart() {
  const taken = [];
  for (const part of [...parts.values()].sort((a, b) => a.middle[1] - b.middle[1])) {
    let [x, y] = part.middle;
    const tall = 18 * Math.max(1, part.chip.childElementCount) + BOTH;
    for (const [ox, oy, oh] of taken) {
      if (Math.abs(ox - x) < 84 && Math.abs(oy - y) < (oh + tall) / 2) y = oy + (oh + tall) / 2;
    }
    taken.push([x, y, tall]);
    if (y === part.middle[1]) continue;
    part.middle = [x, y];
    part.chip.style.transform = `translate(-50%, -50%) translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }
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
