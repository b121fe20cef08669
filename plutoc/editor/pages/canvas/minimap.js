// The whole of a large graph in a corner, with the part that is seen: press or drag to go there.

import { framed, h, shown, svg } from "../dom.js";
import { HEIGHT, app, selection, widthOf, worst } from "../state.js";
import { bounds, camera, look, seen, seenPart, viewport } from "./camera.js";

const MANY = 40;
const WIDTH = 200;
const HIGH = 130;
const EDGE = 40;

const blocks = svg("g");
const frame = svg("rect", { class: "frame" });
const picture = svg("svg", { width: WIDTH, height: HIGH, preserveAspectRatio: "xMidYMid meet" }, blocks, frame);
export const minimap = h("div", { class: "minimap", hidden: true, "aria-hidden": "true" }, picture);

let box = null;

export function drawMinimap() {
  const nodes = [...app.nodes.values()];
  shown(minimap, app.view.blocks.length > MANY);
  if (minimap.hidden) return;
  const { left, top, right, bottom } = bounds(nodes);
  box = { x: left - EDGE, y: top - EDGE, width: right - left + 2 * EDGE, height: bottom - top + 2 * EDGE };
  picture.setAttribute("viewBox", `${box.x} ${box.y} ${box.width} ${box.height}`);
  blocks.replaceChildren(...nodes.map((node) => svg("rect", {
    x: node.x, y: node.y, width: widthOf(node), height: HEIGHT, rx: 10,
    class: selection.blocks.has(node.name) ? "chosen" : worst(node.problems) ?? "",
  })));
  drawFrame();
}

const drawFrame = framed(() => {
  if (minimap.hidden) return;
  const { x, y, width, height } = seenPart();
  for (const [name, value] of Object.entries({ x, y, width, height })) frame.setAttribute(name, value);
  frame.setAttribute("rx", 8 / camera.k);
});
seen.heard(drawFrame);

function goTo(event) {
  event.preventDefault();
  event.stopPropagation();
  const point = new DOMPoint(event.clientX, event.clientY)
    .matrixTransform(picture.getScreenCTM().inverse());
  const { width, height } = viewport.getBoundingClientRect();
  look(width / 2 - point.x * camera.k, height / 2 - point.y * camera.k);
}

minimap.addEventListener("pointerdown", (event) => {
  minimap.setPointerCapture(event.pointerId);
  goTo(event);
});
minimap.addEventListener("pointermove", (event) => { if (event.buttons) goTo(event); });
