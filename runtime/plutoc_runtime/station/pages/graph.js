// The app's own graph with the missions moving through it.
import { h } from "./dom.js";
import { drawing } from "./graph_drawing.js";
import { hasEnded } from "./standing.js";
import { tokens } from "./tokens.js";
import { END, START, finder } from "./ways.js";
import { many } from "./dom.js";

const LIT = 2500; // ms that an edge stays lit after a mission took it

export function graphView(graph, chosen) {
  const view = drawing(graph);
  const seats = tokens(graph, view.tokens, chosen);
  const way = finder(graph.edges);
  const names = new Set(graph.blocks.map((block) => block.name));
  const stand = new Map(); // mission -> blocks
  const hint = "Numbers are missions. Point at a block, or press it, to read what it does.";
  const caption = h("p", { class: "caption", "aria-live": "polite" }, hint);
  const element = h("div", { class: "graph-panel" }, view.element, caption);

  const blockOf = new Map(graph.blocks.map((block) => [block.name, block]));
  const say = (name) => {
    const block = name === null ? null : blockOf.get(name);
    if (!block) {
      caption.replaceChildren(hint);
      return;
    }
    const here = seats.at(name).map((row) => row.name);
    const who = here.length ? `${many(here.length, "mission")} here: ${here.join(", ")}.` : "";
    caption.replaceChildren(h("strong", {}, block.name), ` ${block.doc ?? ""} ${who}`);
  };
  let said = null;
  const read = (name) => {
    said = name;
    say(name);
  };
  for (const [name, box] of view.boxes) {
    for (const kind of ["pointerenter", "focus", "click"]) {
      box.addEventListener(kind, () => read(name));
    }
    for (const kind of ["pointerleave", "blur"]) box.addEventListener(kind, () => read(null));
  }

  const lit = new Map(); // edge -> until when
  let timer = 0;
  const light = (edge) => {
    if (!lit.has(edge)) {
      view.paths.get(edge).classList.add("lit");
      view.paths.get(edge).setAttribute("marker-end", "url(#head-lit)");
    }
    lit.set(edge, performance.now() + LIT);
    timer ||= setTimeout(dim, LIT / 5);
  };
  const dim = () => {
    timer = 0;
    for (const [edge, until] of lit) {
      if (until > performance.now()) continue;
      view.paths.get(edge).classList.remove("lit");
      view.paths.get(edge).setAttribute("marker-end", "url(#head)");
      lit.delete(edge);
    }
    if (lit.size) timer = setTimeout(dim, LIT / 5);
  };

  // A mission that has ended stands at the end, one that has not begun at the start.
  const blocksOf = (row) => {
    const at = row.at.filter((name) => names.has(name));
    if (at.length) return at;
    const aside = hasEnded(row) ? END : row.status === "UNEXECUTED" ? START : null;
    return aside && names.has(aside) ? [aside] : [];
  };
  const update = (missions) => {
    const moves = [];
    const statuses = [];
    for (const row of missions) {
      const from = stand.get(row.name)?.blocks ?? [];
      const to = blocksOf(row);
      const same = from.join("\n") === to.join("\n");
      if (same && stand.get(row.name)?.status === row.status) continue;
      stand.set(row.name, { blocks: to, status: row.status });
      if (same) statuses.push({ row, from, to, ways: new Map() });
      else moves.push({ row, from, to, ways: waysOf(row, from, to) });
    }
    if (!moves.length && !statuses.length) return;
    seats.move([...statuses, ...moves], stand.size);
    for (const { ways } of moves) for (const edges of ways.values()) edges.forEach(light);
    for (const [name, box] of view.boxes) label(name, box);
    if (said !== null) say(said);
  };
  const waysOf = (row, from, to) => {
    const fresh = to.filter((name) => !from.includes(name));
    return new Map(from.length ? fresh.map((name) => [name, way(from, name)]) : []);
  };
  const label = (name, box) => {
    const text = `${name}, ${many(seats.at(name).length, "mission")} here`;
    if (box.getAttribute("aria-label") !== text) box.setAttribute("aria-label", text);
  };
  const clear = () => {
    stand.clear();
    seats.clear();
    for (const [name, box] of view.boxes) label(name, box);
  };
  clear();
  chosen.watch((now, before) => {
    seats.highlight(before);
    seats.highlight(now);
  });
  new ResizeObserver(([entry]) => {
    const { width } = entry.contentRect;
    if (width) view.fit(width, 0);
  }).observe(view.element);
  return { element, update, clear };
}
