// The app's own graph as boxes and arrows. The boxes are buttons: pressing one reads its sentence.
import { h, svg } from "./dom.js";
import { middle, rounded } from "./ways.js";

const plainKind = (kind) => kind.replaceAll(/([a-z])([A-Z])/g, "$1 $2");

function box(block) {
  const named = block.shape === "start" || block.shape === "end" || block.name === block.kind;
  const element = h(
    "button",
    { type: "button", class: `m-block shape-${block.shape}`, "data-block": block.name },
    h("span", { class: "block-name" }, block.name),
    named || !block.kind ? null : h("span", { class: "block-kind" }, plainKind(block.kind)),
  );
  element.style.width = `${block.w}px`;
  element.style.height = `${block.h}px`;
  element.style.transform = `translate(${block.x}px, ${block.y}px)`;
  return element;
}

// The statuses are written where a mission goes different ways with different statuses.
function words(edge, edges) {
  const others = edges.filter((each) => each.from === edge.from && each !== edge);
  const own = edge.statuses.join();
  if (!others.some((each) => each.statuses.join() !== own)) return null;
  const [x, y] = middle(edge.points);
  const text = edge.statuses.join(", ").toLowerCase();
  return svg("text", { class: "taken", x, y: y - 5, "text-anchor": "middle" }, text);
}

// {element, boxes: Map of name -> button, paths: Map of edge -> path, fit(width)}
export function drawing(graph) {
  const boxes = new Map(graph.blocks.map((block) => [block.name, box(block)]));
  const paths = new Map();
  const head = { orient: "auto", viewBox: "0 0 8 8", refX: 7, refY: 4 };
  const heads = ["head", "head-lit"].map((id) =>
    svg(
      "marker",
      { id, ...head, markerWidth: 8, markerHeight: 8, markerUnits: "userSpaceOnUse" },
      svg("path", { class: id, d: "M0 0L8 4L0 8z" }),
    ),
  );
  const picture = svg(
    "svg",
    {
      class: "edges",
      width: graph.width,
      height: graph.height,
      viewBox: `0 0 ${graph.width} ${graph.height}`,
      "aria-hidden": "true",
    },
    svg("defs", {}, ...heads),
  );
  for (const edge of graph.edges) {
    const kinds = ["m-edge", edge.fork ? "fork" : "", edge.dotted ? "dotted" : ""];
    const shape = { class: kinds.join(" ").trim(), d: rounded(edge.points) };
    const path = svg("path", { ...shape, "marker-end": "url(#head)" });
    paths.set(edge, path);
    picture.append(path);
  }
  for (const edge of graph.edges) {
    const text = words(edge, graph.edges);
    if (text) picture.append(text);
  }
  const tokens = h("div", { class: "m-tokens", "aria-hidden": "true" });
  const stage = h("div", { class: "stage" }, picture, ...boxes.values(), tokens);
  stage.style.width = `${graph.width}px`;
  stage.style.height = `${graph.height}px`;
  const room = h("div", { class: "room" }, stage);
  const element = h("div", { class: "graph-view" }, room);
  const fit = (width, height) => {
    const wanted = Math.min(width / graph.width, height ? height / graph.height : Infinity, 1.25);
    const scale = Math.max(wanted, 0.5);
    stage.style.transform = `scale(${scale})`;
    room.style.width = `${graph.width * scale}px`;
    room.style.height = `${graph.height * scale}px`;
  };
  return { element, boxes, paths, tokens, fit };
}
