// Drawing an edge by hand: only blocks that can take it light up, and the others say why not.

import { say, tell } from "../announce.js";
import { h, put, shown, svg } from "../dom.js";
import { ask } from "../link.js";
import { connect, connectAll, redirect } from "../operations.js";
import { app, free, isSource } from "../state.js";
import { showTargets } from "./blocks.js";
import { toWorld, viewport, world } from "./camera.js";
import { follow } from "./follow.js";
import { inPort, portAt } from "./routes.js";

const line = svg("path", { class: "loose" });
const over = svg("svg", { class: "wires over", "aria-hidden": "true" }, line);
const why = h("p", { class: "why-not", hidden: true });

export function prepare() {
  world.append(over);
  viewport.append(why);
}

// A line to where the pointer is.
const loose = ([ax, ay], [bx, by]) => {
  const bend = by > ay ? Math.max(24, (by - ay) / 2) : 48;
  return `M${ax} ${ay}C${ax} ${ay + bend} ${bx} ${by - bend} ${bx} ${by}`;
};

// name → null, or why not; asked of the server, which knows the language.
export async function targetsOf(source, when) {
  const { targets } = await ask("ports", { source, when });
  return targets;
}

export function drawWire(event, source, port, quick) {
  const when = port === "all" ? [] : [port];
  const from = portAt(app.nodes.get(source), port);
  line.dataset.status = port === "all" ? "many" : port;
  drawing(event, targetsOf(source, when), (to) => loose(from, to), (block, end) => {
    if (!end) say("Drag from here to a block, or press C to choose one from a list.");
    else if (block && when.length) connect(source, block, when);
    else if (block) connectAll(source, block);
    else {
      const at = toWorld(end.clientX, end.clientY);
      const statuses = when.length ? when : isSource(source) ? ["UNEXECUTED"] : free(source);
      quick({ at, clientX: end.clientX, clientY: end.clientY, from: source, when, statuses });
    }
  });
}

// One end of an edge is taken to another block.
export function leadEdge(event, edge, which) {
  const start = portAt(app.nodes.get(edge.source), edge.when.length === 1 ? edge.when[0] : "all");
  const end = inPort(app.nodes.get(edge.target));
  line.dataset.status = "many";
  const way = which === "target" ? (to) => loose(start, to) : (to) => loose(to, end);
  const targets = which === "target" ? targetsOf(edge.source, edge.when) : Promise.resolve({});
  drawing(event, targets, way, (block) => {
    if (block && block !== edge[which]) redirect(edge, { [which]: block });
  });
}

// asked: the answer to which blocks are legal; done(block or null, the last event or null: not moved).
function drawing(event, asked, way, done) {
  let [targets, block] = [null, null];
  asked.then((found) => {
    targets = found;
    if (line.classList.contains("drawn")) showTargets(targets);
  }, () => { targets = {}; });
  follow(event, (now) => {
    if (!line.classList.contains("drawn") && targets) showTargets(targets);
    line.classList.add("drawn");
    line.setAttribute("d", way(toWorld(now.clientX, now.clientY)));
    block = document.elementFromPoint(now.clientX, now.clientY)?.closest(".block")?.dataset.block ?? null;
    const reason = block && targets?.[block];
    line.classList.toggle("refused", Boolean(reason));
    explain(reason, now);
  }, async (end, moved) => {
    line.classList.remove("drawn", "refused");
    line.removeAttribute("d");
    showTargets(null);
    explain(null);
    if (end.type !== "pointerup") return;
    const why = moved && block && (targets ?? await asked.catch(() => ({})))[block];
    if (why) tell(why, { kind: "bad", stays: true });
    else done(moved ? block : null, moved ? end : null);
  }, { rim: true });
}

function explain(reason, now) {
  shown(why, reason);
  if (!reason) return;
  put(why, reason.replaceAll("`", ""));
  const { left, top, width } = viewport.getBoundingClientRect();
  const x = Math.max(8, Math.min(now.clientX - left + 16, width - why.offsetWidth - 8));
  why.style.transform = `translate(${x}px, ${now.clientY - top + 18}px)`;
}

