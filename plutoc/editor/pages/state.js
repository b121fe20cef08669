// What is known: the app as the server sees it, and what is selected here.

import { bell } from "./dom.js";
import { pushes } from "./link.js";

export const START = "start";
export const END = "end";

export { HEIGHT, WIDTH, widthOf } from "./canvas/routes.js";
export const GRID = 8;
export const snap = (value) => Math.round(value / GRID) * GRID;

export const app = {
  client: 0, version: 0, file: "", text: "", hooks: null, palette: [], history: {},
  view: { title: "", blocks: [], edges: [], ends: { start: [0, 0], end: [0, 0] }, problems: [],
    events: [], hooks: [], categories: [] },
  nodes: new Map(), // name → block, or start, end, an event
  edges: new Map(), // key → edge
};

export const changed = bell(); // the whole push
export const selected = bell();
export const begun = bell(); // hello: all texts are new

export const keyOf = ({ source, target, when, otherwise }) =>
  `${source}>${target}?${otherwise ? "otherwise" : when.join(",")}`;

export const arrowOf = ({ source, target, when, otherwise }) =>
  ({ source, target, when, otherwise });

export const isEnd = (name) => name === START || name === END || Boolean(app.nodes.get(name)?.event);

// Missions come from here: they have no status before.
export const isSource = (name) => name !== END && isEnd(name);

export const selection = { blocks: new Set(), edge: null };

function take(view) {
  app.view = view;
  app.nodes = new Map();
  for (const name of [START, END]) {
    const [x, y] = view.ends[name];
    app.nodes.set(name, {
      name, kind: name, x, y, terminal: true, problems: [], accepts: [], emits: [], arguments: [],
      doc: name === START ? "Where every mission begins." : "Where missions end.",
    });
  }
  for (const event of view.events) {
    app.nodes.set(event.name, {
      ...event, kind: "event", event: true, terminal: true, problems: [], accepts: [], emits: [], arguments: [],
      doc: event.doc || "An event: what makes missions of it stands behind.",
    });
  }
  for (const block of view.blocks) app.nodes.set(block.name, block);
  app.edges = new Map(view.edges.map((edge) => [keyOf(edge), edge]));
  const blocks = [...selection.blocks].filter((name) => app.nodes.has(name));
  const edge = app.edges.has(selection.edge) ? selection.edge : null;
  if (blocks.length !== selection.blocks.size || edge !== selection.edge) choose(blocks, edge);
}

const applied = (text, changes) => changes.toReversed().reduce(
  (before, { from, to, insert }) => before.slice(0, from) + insert + before.slice(to), text);

pushes.heard((push) => {
  if (push.push === "hello") {
    const { client, version, file, text, hooks, palette, history } = push;
    Object.assign(app, { client, version, file, text, hooks, palette, history: history ?? {} });
    take(push.view);
    begun.ring(push);
  } else if (push.push === "change") {
    app.version = push.version;
    if (push.file === "app") app.text = applied(app.text, push.changes);
    app.history = push.history ?? {};
    take(push.view);
    if (push.by === app.client && push.new?.length) choose(push.new);
    changed.ring(push);
  }
});

export function choose(blocks, edge = null) {
  selection.blocks = new Set(blocks);
  selection.edge = edge;
  selected.ring();
}

export const only = () => (selection.blocks.size === 1 ? [...selection.blocks][0] : null);

// The blocks that are selected; start, end and events are none.
export const chosenBlocks = () => [...selection.blocks].filter((name) => !isEnd(name));

export const outOf = (name) => app.view.edges.filter((edge) => edge.source === name);
export const into = (name) => app.view.edges.filter((edge) => edge.target === name);

// The statuses that an edge takes by what is written, whether they come along it or not.
export function takes(edge) {
  if (edge.when.length) return edge.when;
  return edge.target === END ? ["COMPLETED", "FAILED"] : app.nodes.get(edge.target)?.accepts ?? [];
}

// The statuses that a block emits and no edge of it takes yet.
export function free(name) {
  const node = app.nodes.get(name);
  if (!node || name === END) return [];
  const out = outOf(name).filter((edge) => !edge.implicit);
  if (isSource(name)) return out.length ? [] : ["UNEXECUTED"];
  const taken = new Set(out.flatMap(takes));
  return node.emits.filter((one) => !taken.has(one));
}

export const worst = (indices) => {
  const levels = indices.map((i) => app.view.problems[i]?.severity);
  return levels.includes("error") ? "error" : levels.length ? "warning" : null;
};
