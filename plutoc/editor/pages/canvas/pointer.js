// The mouse, pen or finger on the graph: select, move, select by a box, pan, zoom.

import { say } from "../announce.js";
import { h } from "../dom.js";
import * as operations from "../operations.js";
import {
  HEIGHT, app, arrowOf, choose, chosenBlocks, into, keyOf, outOf, selection, snap, widthOf,
} from "../state.js";
import { elementOf, focusBlock, moveBlock } from "./blocks.js";
import { camera, pan, toWorld, viewport, zoom } from "./camera.js";
import { follow } from "./follow.js";
import { chipOf, edgeAt, moveWires } from "./wires.js";
import { drawWire, leadEdge } from "./wiring.js";

const band = h("div", { class: "band", hidden: true });
let space = false;
let quick = () => {}; // opens the quick palette

export function listen(openQuick, openProperties) {
  quick = openQuick;
  viewport.append(band);
  viewport.addEventListener("pointerdown", down);
  viewport.addEventListener("wheel", wheel, { passive: false });
  viewport.addEventListener("contextmenu", (event) => event.preventDefault());
  viewport.addEventListener("dblclick", (event) => {
    if (event.target.closest(".block, .chip, .edge")) return openProperties();
    const at = toWorld(event.clientX, event.clientY);
    quick({ at, clientX: event.clientX, clientY: event.clientY });
  });
  document.addEventListener("keydown", ({ key }) => { if (key === " ") space = true; });
  document.addEventListener("keyup", ({ key }) => { if (key === " ") space = false; });
}

function wheel(event) {
  event.preventDefault();
  const { deltaX, deltaY, ctrlKey, metaKey, shiftKey, clientX, clientY, deltaMode } = event;
  const unit = deltaMode ? 16 : 1;
  if (ctrlKey || metaKey) zoom(Math.exp(-deltaY * unit / 300), clientX, clientY);
  else if (shiftKey && !deltaX) pan(-deltaY * unit, 0);
  else pan(-deltaX * unit, -deltaY * unit);
}

function down(event) {
  const { target, button, pointerType } = event;
  if (target.closest(".minimap, .zoomer")) return;
  if (button === 1 || button === 2 || space || (pointerType === "touch" && !target.closest(".block, .chip"))) {
    return panning(event);
  }
  if (button) return;
  const port = target.closest(".port");
  const block = target.closest(".block");
  const edge = edgeAt(target);
  event.preventDefault();
  if (target.closest(".handle")) return leadEdge(event, app.edges.get(selection.edge), target.dataset.end);
  if (port) return drawWire(event, block.dataset.block, port.dataset.port, quick);
  if (block) return onBlock(event, block.dataset.block);
  if (edge) {
    choose([], keyOf(edge));
    chipOf(keyOf(edge)).focus({ preventScroll: true });
    return say(operations.edgeSaid(edge));
  }
  return boxing(event);
}

function panning(event) {
  event.preventDefault();
  const [x, y] = [camera.x, camera.y];
  let last = event;
  viewport.classList.add("panning");
  follow(event, (now) => {
    pan(now.clientX - last.clientX, now.clientY - last.clientY);
    last = now;
  }, (end) => {
    viewport.classList.remove("panning");
    if (end.type !== "pointerup") Object.assign(camera, { x, y });
  });
}

function onBlock(event, name) {
  const also = event.shiftKey || event.ctrlKey || event.metaKey;
  const before = selection.blocks;
  if (also) {
    const now = new Set(before);
    if (!now.delete(name)) now.add(name);
    choose(now);
  } else if (!before.has(name)) {
    choose([name]);
  }
  focusBlock(name);
  dragging(event, name, () => { if (!also && before.has(name)) choose([name]); });
}

function dragging(event, name, clicked) {
  const names = selection.blocks.has(name) ? [...selection.blocks] : [];
  const starts = new Map(names.map((one) => [one, { ...app.nodes.get(one) }]));
  const [fx, fy] = toWorld(event.clientX, event.clientY);
  const first = starts.get(name);
  let dropped = null;
  const put = (dx, dy) => {
    for (const [one, { x, y }] of starts) {
      const node = app.nodes.get(one);
      if (!node) continue;
      Object.assign(node, { x: x + dx, y: y + dy });
      moveBlock(one, node);
    }
    moveWires(starts.keys());
  };
  const lone = names.length === 1 && !outOf(name).length && !into(name).length ? name : null;
  for (const one of names) elementOf(one)?.classList.add("dragged");
  follow(event, (now) => {
    const [x, y] = toWorld(now.clientX, now.clientY);
    put(snap(first.x + x - fx) - first.x, snap(first.y + y - fy) - first.y);
    dropped = lone && edgeUnder(now, elementOf(lone));
    markDrop(dropped);
  }, (end, moved) => {
    for (const one of names) elementOf(one)?.classList.remove("dragged");
    markDrop(null);
    if (!moved) {
      put(0, 0);
      return end.type === "pointerup" && clicked();
    }
    if (dropped) return insert(dropped, lone);
    const positions = [...starts.keys()].map((one) => [one, app.nodes.get(one)]);
    return operations.place(Object.fromEntries(positions.map(([one, { x, y }]) => [one, [x, y]])));
  }, { rim: true });
}

// A block without edges that is dropped upon one goes in between.
function insert(edge, name) {
  const { x, y } = app.nodes.get(name);
  operations.edit([
    { do: "Redirect", arrow: arrowOf(edge), target: name },
    { do: "Connect", arrow: operations.arrow(name, edge.target) },
  ], { [name]: [x, y] });
}

// The edge below a pointer, looking through what is dragged.
export function edgeUnder({ clientX, clientY }, through = null) {
  return document.elementsFromPoint(clientX, clientY)
    .filter((one) => !through?.contains(one)).map(edgeAt).find((edge) => edge && !edge.implicit) ?? null;
}

let marked = null;
export function markDrop(edge) {
  const key = edge ? keyOf(edge) : null;
  if (key === marked) return;
  for (const one of document.querySelectorAll(".drop")) one.classList.remove("drop");
  marked = key;
  if (!edge) return;
  for (const one of document.querySelectorAll(`[data-edge="${CSS.escape(key)}"]`)) one.classList.add("drop");
}

function boxing(event) {
  const { left, top } = viewport.getBoundingClientRect();
  const kept = event.shiftKey ? chosenBlocks() : [];
  const inside = () => {
    const [a, b] = [toWorld(box.left, box.top), toWorld(box.right, box.bottom)];
    return [...app.nodes.values()].filter((node) => node.x < b[0] && node.x + widthOf(node) > a[0]
      && node.y < b[1] && node.y + HEIGHT > a[1]).map(({ name }) => name);
  };
  let box = null;
  choose(kept);
  viewport.focus({ preventScroll: true });
  follow(event, (now) => {
    box = {
      left: Math.min(event.clientX, now.clientX), right: Math.max(event.clientX, now.clientX),
      top: Math.min(event.clientY, now.clientY), bottom: Math.max(event.clientY, now.clientY),
    };
    band.hidden = false;
    Object.assign(band.style, {
      transform: `translate(${box.left - left}px, ${box.top - top}px)`,
      width: `${box.right - box.left}px`, height: `${box.bottom - box.top}px`,
    });
  }, (end, moved) => {
    band.hidden = true;
    if (!moved || !box) return;
    const names = [...new Set([...kept, ...inside()])];
    choose(names);
    if (names.length) focusBlock(names[0]);
    say(`${names.length} selected`);
  });
}
