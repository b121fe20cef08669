// A numbered token for each mission, at its block of the graph; it glides along the edges it takes.

import { h, put } from "./dom.js";

const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 20;
const FOLLOWED = 30; // missions: of more, nobody could follow one, so none glides
const still = matchMedia("(prefers-reduced-motion: reduce)");

// finder(edges)(from, to) → the edges of the shortest way from any of the blocks `from` to `to`.
export function finder(edges) {
  return (from, to) => {
    const came = new Map(from.map((block) => [block, []]));
    for (const [block, way] of came) { // it grows while it is read: the nearest come first
      for (const edge of edges) {
        if (edge.from !== block) continue;
        if (edge.to === to) return [...way, edge];
        if (!came.has(edge.to)) came.set(edge.to, [...way, edge]);
      }
    }
    return [];
  };
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

export function tokens(graph, layer, chosen) {
  const here = new Map(graph.blocks.map((block) => [block.name, []])); // block → rows
  const made = new Map(); // "block mission" → token

  // Where the i-th of n tokens sits, in the middle of the block's lower edge.
  function seat(block, i, n) {
    const step = Math.min(SIZE + 2, Math.max(block.w + 36, 132) / n);
    const [x, y] = [block.x + block.w / 2 + step * (i - (n - 1) / 2), block.y + block.h + 4];
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
