// The graph by keyboard: arrows go along edges, and what is selected is moved with Alt.

import { say } from "../announce.js";
import { pressed } from "../dom.js";
import { edgeSaid, place } from "../operations.js";
import { END, GRID, START, app, choose, into, keyOf, outOf, selection, widthOf } from "../state.js";
import { focusBlock, moveBlock } from "./blocks.js";
import { reveal, viewport } from "./camera.js";
import { chipOf, edgeAt, middleOf, moveWires } from "./wires.js";

const WAYS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };

export function listen(openProperties) {
  viewport.addEventListener("keydown", (event) => {
    const name = event.target.closest?.(".block")?.dataset.block;
    const edge = edgeAt(event.target);
    const done = key(event, name, edge, openProperties);
    if (!done) return;
    event.preventDefault();
    event.stopPropagation();
  });
  viewport.addEventListener("focusin", ({ target }) => {
    const name = target.closest?.(".block")?.dataset.block;
    if (name && !selection.blocks.has(name)) choose([name]);
  });
}

function key(event, name, edge, openProperties) {
  const how = pressed(event);
  const way = WAYS[event.key];
  if (how === "Enter" && (name || edge)) return openProperties() ?? true;
  if (how === "Space" && name) return choose([name]) ?? true;
  if (how === "E" && name) return toEdge(outOf(name)[0] ?? into(name)[0]);
  if (how === "Escape") return unfocus(edge);
  if (how === "Home") return go(START);
  if (how === "End") return go(END);
  if (!way) return false;
  if (event.altKey && selection.blocks.size) return shift(way, event.shiftKey ? 4 : 1);
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  if (edge) return fromEdge(edge, event.key);
  if (!name) return go([...selection.blocks][0] ?? START);
  return go(along(name, event.key, way), event.shiftKey);
}

function unfocus(edge) {
  if (edge) return go(edge.source);
  choose([]);
  viewport.focus({ preventScroll: true });
  return true;
}

export function go(name, also = false) {
  const node = app.nodes.get(name);
  if (!node) return true;
  choose(also ? [...selection.blocks, name] : [name]);
  reveal(node);
  focusBlock(name);
  return true;
}

// Down and up: along edges. Right and left: to the next block that way.
function along(name, key_, way) {
  const here = app.nodes.get(name);
  const ends = key_ === "ArrowDown" ? outOf(name).map((edge) => edge.target)
    : key_ === "ArrowUp" ? into(name).map((edge) => edge.source) : [];
  const linked = ends.filter((one) => one !== name).map((one) => app.nodes.get(one));
  const forward = linked.filter((node) => (node.y - here.y) * way[1] > 0);
  const choices = forward.length ? forward : linked;
  if (choices.length) return nearest(here, choices).name;
  const others = [...app.nodes.values()].filter((node) =>
    (node.x - here.x) * way[0] + (node.y - here.y) * way[1] > 0);
  const straight = others.filter((node) => {
    const [dx, dy] = [Math.abs(node.x - here.x), Math.abs(node.y - here.y)];
    return way[0] ? dx >= dy : dy * 2 >= dx;
  });
  return (straight.length ? nearest(here, straight) : others.length ? nearest(here, others) : here).name;
}

function nearest(here, nodes) {
  const middle = (node) => node.x + widthOf(node) / 2;
  const far = (node) => Math.hypot(middle(node) - middle(here), 2 * (node.y - here.y));
  return nodes.reduce((best, node) => (far(node) < far(best) ? node : best));
}

export function toEdge(edge) {
  if (!edge) {
    say("No edge touches this block.");
    return true;
  }
  choose([], keyOf(edge));
  const [x, y] = middleOf(keyOf(edge));
  reveal({ x: x - 60, y: y - 20, name: "" });
  chipOf(keyOf(edge)).focus({ preventScroll: true });
  return true;
}

// On an edge: up to its source, down to its target, left and right to the other edges of the source.
function fromEdge(edge, key_) {
  if (key_ === "ArrowUp") return go(edge.source);
  if (key_ === "ArrowDown") return go(edge.target);
  const around = [...outOf(edge.source), ...into(edge.source)];
  const here = around.findIndex((one) => keyOf(one) === keyOf(edge));
  const by = key_ === "ArrowRight" ? 1 : around.length - 1;
  const next = around[(here + by) % around.length];
  say(edgeSaid(next));
  return toEdge(next);
}

let moved = null;
let later = 0;
const SETTLED = 250; // milliseconds without a key: then the move is one step of the history

function shift([dx, dy], by) {
  moved ??= new Map();
  for (const name of selection.blocks) {
    const node = app.nodes.get(name);
    Object.assign(node, { x: node.x + dx * GRID * by, y: node.y + dy * GRID * by });
    moved.set(name, [node.x, node.y]);
    moveBlock(name, node);
  }
  moveWires(selection.blocks);
  clearTimeout(later);
  later = setTimeout(() => {
    place(Object.fromEntries(moved));
    moved = null;
  }, SETTLED);
  return true;
}
