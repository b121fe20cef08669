// The app's own graph as boxes and arrows, with the missions moving through it.

import { fill, h, many, set, svg } from "./dom.js";
import { ended } from "./standing.js";
import { finder, tokens } from "./tokens.js";

const LIT = 2500; // ms that an edge stays lit after a mission took it
const HINT = "Numbers are missions. Point at a block, or press it, to read what it does.";

function box({ name, kind, shape, x, y, w, h: height }) {
  const words = kind.replaceAll(/([a-z])([A-Z])/g, "$1 $2");
  const element = h("button", { class: `block ${shape}-block` }, h("b", null, name),
    kind && h("small", null, words));
  const { style } = element;
  [style.width, style.height] = [`${w}px`, `${height}px`];
  style.transform = `translate(${x}px, ${y}px)`;
  return element;
}

// The corners are rounded.
function path(points) {
  const near = ([x, y], [toX, toY]) => {
    const length = Math.hypot(toX - x, toY - y) || 1;
    const part = Math.min(8, length / 2) / length;
    return `${x + (toX - x) * part} ${y + (toY - y) * part}`;
  };
  return points.map((point, i) => {
    if (!i) return `M${point.join(" ")}`;
    const next = points[i + 1];
    if (!next) return `L${point.join(" ")}`;
    return `L${near(point, points[i - 1])}Q${point.join(" ")} ${near(point, next)}`;
  }).join("");
}

const head = (id) => svg("marker", {
  id, orient: "auto", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 8, markerHeight: 8,
  markerUnits: "userSpaceOnUse",
}, svg("path", { d: "M0 0L8 4L0 8z" }));

export function graphView({ live, app: { graph } }, chosen) {
  const { width, height, blocks, edges } = graph;
  const boxes = new Map(blocks.map((block) => [block.name, box(block)]));
  const paths = new Map(edges.map((edge) => [edge, svg("path", {
    class: `edge ${edge.fork ? "fork" : ""} ${edge.dotted ? "dotted" : ""}`, d: path(edge.points),
  })]));
  const layer = h("div", { class: "tokens", "aria-hidden": "true" });
  const labels = edges.filter((edge) => edge.label).map(({ label: [x, y], statuses }) =>
    svg("text", { x, y, "text-anchor": "middle" }, statuses.join(", ").toLowerCase()));
  const stage = h("div", { class: "stage" },
    svg("svg", { width, height, "aria-hidden": "true" },
      svg("defs", null, head("head"), head("head-lit")), ...paths.values(), labels),
    ...boxes.values(), layer);
  const room = h("div", { class: "room" }, stage);
  const view = h("div", { class: "graph-view" }, room);
  new ResizeObserver(([{ contentRect }]) => {
    if (!contentRect.width) return;
    const scale = Math.max(0.55, Math.min(contentRect.width / width, 1.25));
    stage.style.transform = `scale(${scale})`;
    room.style.width = `${width * scale}px`;
    room.style.height = `${height * scale}px`;
  }).observe(view);

  const seats = tokens(graph, layer, chosen);
  const way = finder(edges);
  const stood = new Map(); // mission → { blocks, status }
  const caption = h("p", { class: "caption" }, HINT);
  let read = null; // the block that is read now

  function say(block = read) {
    read = block;
    if (!block) {
      fill(caption, HINT);
      return;
    }
    const rows = seats.at(block.name);
    const who = rows.length && ` ${many(rows.length, "mission")} here: ${rows.map((row) => row.name).join(", ")}.`;
    fill(caption, h("strong", null, block.name), ` ${block.doc}`, who || null);
  }
  for (const block of blocks) {
    const element = boxes.get(block.name);
    for (const kind of ["pointerenter", "focus", "click"]) {
      element.addEventListener(kind, () => say(block));
    }
    for (const kind of ["pointerleave", "blur"]) element.addEventListener(kind, () => say(null));
  }
  function light(edge) {
    const element = paths.get(edge);
    clearTimeout(element.timer);
    element.classList.add("lit");
    element.timer = setTimeout(() => element.classList.remove("lit"), LIT);
  }
  // A mission that has not begun stands at the start.
  function blocksOf(row) {
    const at = row.at.filter((name) => boxes.has(name));
    if (at.length || !boxes.has("start")) return at;
    return row.status === "UNEXECUTED" ? ["start"] : ended(row) ? ["end"] : at;
  }
  function update({ missions }) {
    const moves = [];
    for (const name of missions) {
      const row = live.missions.get(name);
      const { blocks: from, status } = stood.get(name) ?? { blocks: [] };
      const to = blocksOf(row);
      const same = from.join() === to.join();
      if (same && status === row.status) continue;
      stood.set(name, { blocks: to, status: row.status });
      const fresh = same || !from.length ? [] : to.filter((block) => !from.includes(block));
      moves.push({ row, from, to, ways: fresh.map((block) => [block, way(from, block)]) });
    }
    if (!moves.length) return;
    seats.move(moves, stood.size);
    for (const { ways } of moves) ways.forEach(([, taken]) => taken.forEach(light));
    count();
  }
  function count() {
    for (const { name, doc } of blocks) {
      const here = `${many(seats.at(name).length, "mission")} here`;
      set(boxes.get(name), "aria-label", `${name}: ${doc} ${here}`);
    }
    say();
  }
  function clear() {
    stood.clear();
    seats.clear();
    count();
  }
  clear();
  return { body: [view, caption], update, clear };
}
