// The picture of the graph, put together.

import { h, icon, put, signButton } from "../dom.js";
import { app, begun, changed, selected } from "../state.js";
import { drawBlocks, focusBlock, layer, markBlocks } from "./blocks.js";
import { begin, camera, fit, reveal, seen, viewport, world, zoom, zoomTo } from "./camera.js";
import * as keys from "./keys.js";
import { drawMinimap, minimap } from "./minimap.js";
import * as pointer from "./pointer.js";
import { chips, drawWires, grips, markEdges, wires } from "./wires.js";
import { prepare } from "./wiring.js";

const percent = h("button", {
  type: "button", class: "button quiet percent", title: "Back to 100 %", onclick: () => zoomTo(1),
}, "100 %");

const zoomer = h("div", { class: "zoomer", role: "group", "aria-label": "Zoom" },
  signButton("Zoom out", () => zoom(1 / 1.25), "minus"), percent,
  signButton("Zoom in", () => zoom(1.25), "plus"),
  signButton("Fit the graph into the window (F)", () => fitAll(), "fit"));

const hint = h("div", { class: "first-steps", hidden: true }, icon("plus", 22),
  h("p", {}, h("strong", {}, "Add the first block")),
  h("p", {}, "Click one in the list, or drag it here. Or double-click the ground, or press A, and type. "
    + "A block is connected from the one that is selected."));

export const fitAll = () => fit([...app.nodes.values()], true);

export function makeCanvas({ quick, properties }) {
  viewport.tabIndex = -1;
  viewport.setAttribute("role", "application");
  viewport.setAttribute("aria-label", "Graph");
  viewport.setAttribute("aria-roledescription", "graph of blocks");
  viewport.id = "graph";
  world.append(wires, chips, layer, grips);
  viewport.append(hint, minimap, zoomer);
  prepare();
  pointer.listen(quick, properties);
  keys.listen(properties);
  seen.heard(() => put(percent, `${Math.round(camera.k * 100)} %`));
  begun.heard(() => {
    draw();
    requestAnimationFrame(() => begin([...app.nodes.values()]));
  });
  changed.heard(({ by, new: fresh }) => {
    draw();
    if (camera.fitted) fitAll();
    if (by !== app.client || !fresh?.length) return;
    const node = app.nodes.get(fresh[0]);
    if (node && !camera.fitted) reveal(node);
    if (viewport.contains(document.activeElement) || document.activeElement === document.body) {
      focusBlock(fresh[0]);
    }
  });
  new ResizeObserver(() => { if (camera.fitted) fitAll(); }).observe(viewport);
  selected.heard(() => {
    markBlocks();
    markEdges();
    drawMinimap();
  });
  return viewport;
}

function draw() {
  drawBlocks();
  drawWires();
  drawMinimap();
  hint.hidden = app.view.blocks.length > 0;
}
