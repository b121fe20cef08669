// A rectangle or a line that is drawn over the ground: to select pins, or to put many trips at once.

import { h } from "preact";
import { useRef } from "preact/hooks";
import { rounded } from "./snapping.js";
import { abouts, drawn, markAll, marked, tool } from "./state.js";

/** @import { Camera } from "../map/camera.js" */

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
