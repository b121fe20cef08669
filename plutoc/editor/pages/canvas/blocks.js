// The blocks, and start and end: what they show, and which are marked.

import { h, icon, keyed, put, set, shown } from "../dom.js";
import { END, START, app, isEnd, selection, worst } from "../state.js";
import { slots } from "./routes.js";

export const layer = h("div", { class: "blocks" });

let elements = new Map();
export const elementOf = (name) => elements.get(name);

export function drawBlocks() {
  elements = keyed(layer, [...app.nodes.values()], (node) => node.name, make, update);
  markBlocks();
}

function make({ name, terminal, event }) {
  return h("div", {
    class: `block${terminal ? " terminal" : ""}${event ? " event" : ""}`, "data-block": name, role: "button", tabIndex: -1,
    "aria-roledescription": event ? "event" : terminal ? "end of the graph" : "block",
  },
  h("span", { class: "face" },
    h("span", { class: "name" }), !terminal && h("span", { class: "kind" }),
    !terminal && h("span", { class: "badge", hidden: true }, icon("warning", 13), h("span"))),
  name !== END && h("span", { class: "ports" }),
  h("span", { class: "tokens" }));
}

function update(element, node) {
  const { name, kind, emits, problems, gate, hook } = node;
  put(element.querySelector(".name"), name);
  moveBlock(name, node, element);
  if (name !== END) drawPorts(element.querySelector(".ports"), emits);
  if (isEnd(name)) return set(element, "aria-label", `${name}, ${node.doc}`);
  put(element.querySelector(".kind"), hook ? `${kind} · ${hook}` : kind);
  element.classList.toggle("gate", Boolean(gate));
  element.classList.toggle("own", Boolean(hook));
  const level = worst(problems);
  set(element, "data-problem", level);
  const badge = element.querySelector(".badge");
  shown(badge, level);
  put(badge.lastChild, problems.length);
  badge.title = problems.map((i) => app.view.problems[i]?.message).join("\n");
  const trouble = problems.map((i) => app.view.problems[i]?.message).join(" ");
  set(element, "aria-label", `${name}, ${kind}${trouble ? `. Problem: ${trouble}` : ""}`);
  return element;
}

function drawPorts(ports, emits) {
  if (ports.dataset.emits === emits.join()) return;
  ports.dataset.emits = emits.join();
  ports.style.setProperty("--before", slots(emits).indexOf("all"));
  ports.replaceChildren(...slots(emits).map((one) => h("span", {
    class: "port", "data-port": one, "data-status": one === "all" ? "many" : one,
    title: one === "all" ? "Drag to connect: all that is free" : `Drag to connect: when ${one}`,
  })));
}

export function moveBlock(name, { x, y }, element = elements.get(name)) {
  element.style.transform = `translate(${x}px, ${y}px)`;
}

export function markBlocks() {
  const entry = focusable();
  for (const [name, element] of elements) {
    const chosen = selection.blocks.has(name);
    element.classList.toggle("chosen", chosen);
    set(element, "aria-pressed", String(chosen));
    element.tabIndex = name === entry ? 0 : -1; // one stop of Tab for the whole graph
  }
}

const focusable = () =>
  [...selection.blocks].find((name) => elements.has(name)) ?? (elements.has(START) ? START : null);

export function focusBlock(name) {
  elements.get(name)?.focus({ preventScroll: true });
}

// While a wire is drawn: which blocks take it, and why the others do not. null: none is drawn.
export function showTargets(targets) {
  layer.classList.toggle("wiring", Boolean(targets));
  for (const [name, element] of elements) {
    const why = targets?.[name];
    element.classList.toggle("legal", Boolean(targets) && why === null);
    element.classList.toggle("illegal", Boolean(targets) && why !== null);
  }
}

export function light(names) {
  for (const [name, element] of elements) element.classList.toggle("lit", names.has(name));
}
