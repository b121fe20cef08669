// The app's own graph as boxes and arrows, with the missions moving through it.

import { fill, h, many, put, set, svg } from "./dom.js";
import { ended } from "./table.js";

const LIT = 2500; // ms that an edge stays lit after a mission took it
const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 20;
const FOLLOWED = 30; // missions: of more, nobody could follow one, so none glides
const still = matchMedia("(prefers-reduced-motion: reduce)");
const HINT = "Numbers are missions. Point at a block, or press it, to read what it does.";

// finder(graph)(from, status, to, final) → the edges of the shortest way from one of the blocks
// `from`, left with a status, to `to`, reached with the final one; [] where no way fits, so that
// nothing is lit that cannot have been. Any block but a gate can turn what comes into that status.
export function finder({ blocks, edges }) {
  const gates = blocks.filter((block) => block.shape === "gate").map((block) => block.name);
  return (from, status, to, final) => {
    const found = new Map(from.map((block) => [`${block} ${status}`, { block, status, way: [] }]));
    for (const { block, status: now, way } of found.values()) { // it grows: the nearest come first
      for (const edge of edges) {
        if (edge.from !== block || !edge.statuses.includes(now)) continue;
        if (edge.to === to && now === final) return [...way, edge];
        for (const next of gates.includes(edge.to) ? [now] : [now, final]) {
          const [key, longer] = [`${edge.to} ${next}`, [...way, edge]];
          if (!found.has(key)) found.set(key, { block: edge.to, status: next, way: longer });
        }
      }
    }
    return [];
  };
}

// With which status a mission left where it was: what came of its trip, if it flew one.
function leftWith(before, row) {
  if (before.status !== "RUNNING") return before.status;
  if (row.status === "FAILED" || row.attempt > before.attempt) return "FAILED";
  return row.round > before.round || before.done + 1 >= before.total ? "COMPLETED" : "STANDBY";
}

function glide(token, edges) {
  const points = [...edges.flatMap((edge) => edge.points)];
  const far = [0];
  points.slice(1).forEach(([x, y], i) => {
    far.push(far[i] + Math.hypot(x - points[i][0], y - points[i][1]));
  });
  const frames = points.map(([x, y], i) => ({
    transform: `translate(${x - SIZE / 2}px, ${y - SIZE / 2}px)`,
    offset: (0.85 * far[i]) / (far.at(-1) || 1),
  }));
  token.animate([...frames, { transform: token.style.transform }],
    { duration: 600 + 150 * edges.length, easing: "ease-in-out" });
}

function tokens(graph, layer, chosen) {
  const here = new Map(graph.blocks.map((block) => [block.name, []])); // block → rows
  const made = new Map(); // "block mission" → token

  // Where the i-th of n tokens sits, in the middle of the block's lower edge.
  function seat(block, i, n) {
    const step = Math.min(SIZE + 2, Math.max(block.w + 36, 110) / n);
    const half = (step * (n - 1) + SIZE) / 2;
    const middle = Math.min(Math.max(block.x + block.w / 2, half), graph.width - half);
    const [x, y] = [middle + step * (i - (n - 1) / 2), block.y + block.h + 4];
    return `translate(${x - SIZE / 2}px, ${y - SIZE / 2}px)`;
  }
  function token(key, text, props) {
    if (!made.has(key)) {
      made.set(key, h("span", { class: "token", ...props }));
      layer.append(made.get(key));
    }
    return put(made.get(key), text);
  }
  // The first six by number, the chosen mission always among them.
  function arrange(block) {
    const rows = here.get(block.name).sort((a, b) => a.index - b.index);
    const first = rows.slice(0, SEATS);
    const picked = rows.find((row) => row.name === chosen.name);
    if (picked && !first.includes(picked)) first[SEATS - 1] = picked;
    const seats = Math.min(rows.length, SEATS + 1);
    const kept = new Set(first.map((row, i) => {
      const choose = { title: row.name, onclick: () => chosen.set(row.name) };
      const one = token(`${block.name} ${row.name}`, row.index + 1, choose);
      one.style.transform = seat(block, i, seats);
      one.dataset.status = row.status;
      one.classList.toggle("picked", row === picked);
      return one;
    }));
    if (rows.length > SEATS) {
      const rest = token(block.name, `+${rows.length - SEATS}`, { "data-rest": "" });
      rest.style.transform = seat(block, SEATS, seats);
      kept.add(rest);
    }
    for (const [key, one] of made) {
      if ((key !== block.name && !key.startsWith(`${block.name} `)) || kept.has(one)) continue;
      one.remove();
      made.delete(key);
    }
  }
  // moves: [{ row, from: [names], to: [names], ways: [[name, edges]…] }], of so many missions
  function move(moves, missions) {
    const lively = missions <= FOLLOWED && !still.matches;
    layer.classList.toggle("lively", lively);
    const touched = new Set();
    for (const { row, from, to } of moves) {
      for (const name of from) {
        here.set(name, here.get(name).filter((other) => other.name !== row.name));
        touched.add(name);
      }
      for (const name of to) {
        here.get(name).push(row);
        touched.add(name);
      }
    }
    for (const block of graph.blocks) if (touched.has(block.name)) arrange(block);
    if (!lively || document.hidden) return;
    for (const { row, ways } of moves) {
      for (const [name, edges] of ways) {
        const one = made.get(`${name} ${row.name}`);
        if (one && edges.length) glide(one, edges);
      }
    }
  }
  function clear() {
    for (const name of here.keys()) here.set(name, []);
    made.clear();
    layer.replaceChildren();
  }
  chosen.changed.heard(() => graph.blocks.forEach(arrange));
  return { move, clear, at: (name) => here.get(name) };
}

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
  const way = finder(graph);
  const stood = new Map(); // mission → its row before, and the blocks where it was
  const caption = h("p", { class: "caption" }, HINT);
  let read = null; // the block that is read now

  function say(block = read) {
    read = block;
    if (!block) {
      fill(caption, HINT);
      return;
    }
    const rows = seats.at(block.name);
    const names = rows.map((row) => row.name).join(", ");
    const who = rows.length && ` ${many(rows.length, "mission")} here: ${names}.`;
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
      const { blocks: from, before } = stood.get(name) ?? { blocks: [] };
      const to = blocksOf(row);
      stood.set(name, { blocks: to, before: row });
      const same = from.join() === to.join();
      if (same && before?.status === row.status) continue;
      const fresh = before ? to.filter((block) => !from.includes(block)) : [];
      moves.push({ row, from, to, ways: fresh.map((block) =>
        [block, way(from, leftWith(before, row), block, row.status)]) });
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
