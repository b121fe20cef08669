// What part of the graph is seen, and how large.

import { bell, framed, h } from "../dom.js";
import { HEIGHT, widthOf } from "../state.js";

const LEAST = 0.04;
const MOST = 2;
const FAR = 0.45; // below, what is too small to be read is left out
const FARTHER = 0.28;
const MARGIN = 36;
const READABLE = 0.42;

export const camera = { x: 0, y: 0, k: 1, fitted: true }; // fitted: until it is moved by hand
export const seen = bell(); // it has moved

export const world = h("div", { class: "world" });
export const viewport = h("div", { class: "viewport" }, world);

const apply = framed(() => {
  const { x, y, k } = camera;
  world.style.transform = `translate(${x}px, ${y}px) scale(${k})`;
  viewport.style.setProperty("--grid", `${16 * k * (k < 0.5 ? 4 : 1)}px`);
  viewport.style.setProperty("--grid-x", `${x}px`);
  viewport.style.setProperty("--grid-y", `${y}px`);
  viewport.classList.toggle("far", k < FAR);
  viewport.classList.toggle("farther", k < FARTHER);
  seen.ring();
});

const size = () => viewport.getBoundingClientRect();

export function toWorld(clientX, clientY) {
  const { left, top } = size();
  return [(clientX - left - camera.x) / camera.k, (clientY - top - camera.y) / camera.k];
}

export function look(x, y, k = camera.k, fitted = false) {
  Object.assign(camera, { x, y, k, fitted });
  world.classList.toggle("glides", fitted);
  apply();
}

export const pan = (dx, dy) => look(camera.x + dx, camera.y + dy);

// About a point of the viewport, by default its middle.
export function zoom(factor, clientX, clientY) {
  const { left, top, width, height } = size();
  const [cx, cy] = clientX === undefined ? [width / 2, height / 2] : [clientX - left, clientY - top];
  const k = Math.min(MOST, Math.max(LEAST, camera.k * factor));
  const grown = k / camera.k;
  look(cx - (cx - camera.x) * grown, cy - (cy - camera.y) * grown, k);
}

export const zoomTo = (k) => zoom(k / camera.k);

export function bounds(nodes) {
  const lefts = nodes.map((node) => node.x);
  const tops = nodes.map((node) => node.y);
  return {
    left: Math.min(...lefts), top: Math.min(...tops),
    right: Math.max(...nodes.map((node) => node.x + widthOf(node))),
    bottom: Math.max(...tops) + HEIGHT,
  };
}

export function fit(nodes, all = false) {
  if (!nodes.length) return;
  const { width, height } = size();
  const { left, top, right, bottom } = bounds(nodes);
  const k = Math.max(LEAST, Math.min(1, (width - 2 * MARGIN) / (right - left || 1),
    (height - 2 * MARGIN) / (bottom - top || 1)));
  look((width - (left + right) * k) / 2, (height - (top + bottom) * k) / 2, k, all);
}

// As opened: all of it, or, where that could not be read, the top of it.
export function begin(nodes) {
  fit(nodes, true);
  if (camera.k >= READABLE || !nodes.length) return;
  const { left, top, right } = bounds(nodes);
  const { width } = size();
  look((width - (left + right) * READABLE) / 2, MARGIN - top * READABLE, READABLE);
}

// Moves no further than is needed to see a block.
export function reveal(node) {
  const { width, height } = size();
  const { x, y, k } = camera;
  const box = [node.x * k + x, node.y * k + y, (node.x + widthOf(node)) * k + x,
    (node.y + HEIGHT) * k + y];
  const by = (low, high, room) => (low < 24 ? 24 - low : high > room - 24 ? room - 24 - high : 0);
  const [dx, dy] = [by(box[0], box[2], width), by(box[1], box[3], height)];
  if (dx || dy) pan(dx, dy);
}

export function seenPart() {
  const { width, height } = size();
  const { x, y, k } = camera;
  return { x: -x / k, y: -y / k, width: width / k, height: height / k };
}
