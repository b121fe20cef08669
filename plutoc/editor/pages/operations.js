// What a gesture means, said to the server. It answers with the text's smallest edits, for all.

import { refused, say, tell } from "./announce.js";
import { ask } from "./link.js";
import {
  END, HEIGHT, START, WIDTH, app, arrowOf, choose, chosenBlocks, free, isEnd, isSource, only, outOf, selection,
  widthOf,
} from "./state.js";

const GAP = 68; // to the block that is put behind another one

// Several operations are one step of the history. The name "" in them is that of the block just added.
export async function edit(operations, positions = {}) {
  try {
    return await ask("edit", { operations, positions, version: app.version });
  } catch (error) {
    refused(error);
    return null;
  }
}

export const arrow = (source, target, when = [], otherwise = false) =>
  ({ source, target, when, otherwise });

const kindOf = (name) => app.palette.find((one) => one.kind === name);

// The guard with which a block's free statuses go to one that accepts these; null: they cannot.
export function guardTo(source, accepts) {
  const wanted = free(source).filter((status) => accepts.includes(status));
  if (isSource(source)) return free(source).length ? [] : null;
  if (!wanted.length) return null;
  const emits = app.nodes.get(source).emits.filter((status) => accepts.includes(status));
  return wanted.length === emits.length ? [] : wanted;
}

// The block from which a new one is connected: the selected one, else the last with a free status.
export function origin(accepts) {
  const chosen = only();
  if (chosen) return guardTo(chosen, accepts) ? chosen : null;
  if (selection.blocks.size) return null;
  return guardTo(START, accepts) ? START : null;
}

const overlaps = (x, y) => [...app.nodes.values()].some((node) =>
  Math.abs(node.x - x) < WIDTH + 8 && Math.abs(node.y - y) < HEIGHT + 8);

function placeBehind(name) {
  const node = app.nodes.get(name);
  const y = node.y + HEIGHT + GAP;
  let x = node.x + (widthOf(node) - WIDTH) / 2;
  while (overlaps(x, y)) x += WIDTH + 48;
  return [x, y];
}

export const EVENT = "event";

// Declares an event under a free name, and selects it.
async function addEvent(at) {
  const taken = new Set([...app.nodes.keys(), ...[...app.view.hooks, ...app.view.categories].map((one) => one.name)]);
  let name = "my_event";
  for (let n = 2; taken.has(name); n += 1) name = `my_event_${n}`;
  const made = await edit([{ do: "Declare", text: `event ${name}` }], at ? { [name]: at } : {});
  if (made) choose([name]);
  return made;
}

// at: where it was dropped, null: behind the one it is connected from.
export function add(kind, { at = null, from = undefined, when = undefined, onto = null } = {}) {
  if (kind === EVENT) return addEvent(at);
  const declared = kindOf(kind);
  if (!declared) return null;
  const operations = [{ do: "AddBlock", kind }];
  let position = at;
  if (onto) {
    operations.push({ do: "Redirect", arrow: arrowOf(onto), target: "" });
    operations.push({ do: "Connect", arrow: arrow("", onto.target) });
  } else {
    const source = from === undefined ? origin(declared.accepts) : from;
    const guard = source && (when ?? guardTo(source, declared.accepts));
    if (source && guard) {
      operations.push({ do: "Connect", arrow: arrow(source, "", guard) });
      position ??= null; // the layout knows where it goes
    } else if (!at && only()) {
      position = placeBehind(only());
    }
  }
  return edit(operations, position ? { "": position } : {});
}

export function connect(source, target, when = [], otherwise = false) {
  return edit([{ do: "Connect", arrow: arrow(source, target, when, otherwise) }]);
}

// What the port of all statuses means: those that are free, or all where none is.
export function connectAll(source, target) {
  const accepts = target === END ? ["COMPLETED", "FAILED"] : app.nodes.get(target).accepts;
  if (target === END) return connect(source, END, [], outOf(source).length > 0);
  return connect(source, target, guardTo(source, accepts) ?? []);
}

export const disconnect = (edge) => edit([{ do: "Disconnect", arrow: arrowOf(edge) }]);
export const redirect = (edge, ends) => edit([{ do: "Redirect", arrow: arrowOf(edge), ...ends }]);
export const setGuard = (edge, when, otherwise) =>
  edit([{ do: "SetGuard", arrow: arrowOf(edge), when, otherwise }]);
export const setArgument = (owner, parameter, value) =>
  edit([{ do: "SetArgument", owner, parameter, value }]);
export const rename = (name, to) => edit([{ do: "Rename", name, new: to }]);
export const setTitle = (title) => edit([{ do: "SetTitle", title }]);
export const declare = (text) => edit([{ do: "Declare", text }]);

// A declaration under another name is renamed everywhere first.
export function rewrite(name, text) {
  const now = /^\w+\s+(\w+)/.exec(text)?.[1] ?? name;
  const renamed = now === name ? [] : [{ do: "Rename", name, new: now }];
  return edit([...renamed, { do: "Rewrite", name: now, text }]);
}

// A field is called `mission.patient`; under another name it is renamed everywhere first.
// planned: missions files may have it.
export async function rewriteField(name, text, { planned = true } = {}) {
  const [on, called] = name.split(".");
  const now = /^\s*(\w+)/.exec(text)?.[1] ?? called;
  const renamed = now === called ? [] : [{ do: "Rename", name, new: now }];
  const done = await edit([...renamed, { do: "Rewrite", name: `${on}.${now}`, text }]);
  if (done?.note && planned) tell(`${done.note}.`);
  return done;
}

export const removeDeclaration = (name) => edit([{ do: "RemoveDeclaration", name }]);

export async function removeSelected() {
  const edge = app.edges.get(selection.edge);
  if (edge) {
    if (await disconnect(edge)) say(`The edge from ${edge.source} to ${edge.target} is removed.`);
    return;
  }
  const names = chosenBlocks();
  if (await edit([{ do: "RemoveBlocks", names }])) say(`${names.join(", ")} removed.`);
}

export const duplicate = () => edit([{ do: "Duplicate", names: chosenBlocks() }]);

// The selected blocks as Pluto text: their declarations, and the edges among them.
export function asText() {
  const names = new Set(chosenBlocks());
  const blocks = app.view.blocks.filter((block) => names.has(block.name));
  const lines = blocks.map((block) => app.text.slice(block.from, block.to).trim());
  const inner = app.view.edges.filter((edge) =>
    names.has(edge.source) && names.has(edge.target) && !edge.implicit);
  for (const edge of inner) {
    lines.push(`${edge.source} -> ${edge.target} ${guardSaid(edge)}`.trim());
  }
  return `${lines.join("\n")}\n`;
}

export const paste = (text) => edit([{ do: "Paste", text }]);

export function place(positions) {
  return ask("place", { positions }).catch(refused);
}

export function tidy() {
  return ask("tidy").then(() => say("The layout is tidied."), refused);
}

export async function undo(op = "undo") {
  try {
    const { said } = await ask(op);
    say(said ?? (op === "undo" ? "Undone." : "Done again."));
  } catch (error) {
    refused(error);
  }
}

// An edge's guard as it is written.
export const guardSaid = ({ when, otherwise }) =>
  (otherwise ? "otherwise" : when.length ? `when ${when.join(", ")}` : "");

// An edge's other words, for people.
export function edgeSaid(edge) {
  const guard = guardSaid(edge);
  const statuses = edge.statuses.length ? edge.statuses.join(", ") : edge.known ? "nothing yet" : "not known";
  return `${edge.source} to ${edge.target}${guard && `, ${guard}`}: ${statuses}`;
}
