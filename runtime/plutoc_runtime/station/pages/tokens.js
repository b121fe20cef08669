// A numbered token for each mission, at its block; it glides along the edges that it takes.
import { h } from "./dom.js";
import { keyframes } from "./ways.js";

const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 20;
const STEP = 22;
const ROOM = [36, 132]; // a row of tokens may be so much wider than its block, or this wide
const FOLLOWED = 30; // missions: of more, nobody could follow one, so none glides
const TIME = 700; // ms

const still = matchMedia("(prefers-reduced-motion: reduce)");

// seat(block, i, n): where the i-th of n tokens stands, on the lower edge of the block's box.
function seat(block, index, count) {
  const shown = Math.min(count, SEATS + 1);
  const step = Math.min(STEP, Math.max(block.w + ROOM[0], ROOM[1]) / shown);
  const left = block.x + block.w / 2 - (step * (shown - 1)) / 2;
  return [left + step * index - SIZE / 2, block.y + block.h - SIZE / 2 + 5];
}

export function tokens(graph, layer, chosen) {
  const blocks = new Map(graph.blocks.map((block) => [block.name, block]));
  const here = new Map(graph.blocks.map((block) => [block.name, []]));
  const more = new Map();
  const marks = new Map(); // "mission block" -> token
  const key = (row, block) => `${row.name}\n${block}`;

  const make = (row, block) => {
    const token = h("span", { class: "m-token", title: row.name }, String(row.index + 1));
    token.addEventListener("click", () => chosen.set(row.name));
    marks.set(key(row, block), token);
    layer.append(token);
    return token;
  };
  const place = (token, [x, y]) => {
    token.style.transform = `translate(${x}px, ${y}px)`;
  };

  // Who is at a block: the first six by number, the chosen one always among them.
  const arrange = (name) => {
    const block = blocks.get(name);
    const rows = here.get(name).sort((a, b) => a.index - b.index);
    const first = rows.slice(0, SEATS);
    const picked = rows.find((row) => row.name === chosen.get());
    if (picked && !first.includes(picked)) first[SEATS - 1] = picked;
    for (const row of rows) {
      const index = first.indexOf(row);
      const token = marks.get(key(row, name));
      if (index < 0) {
        token?.remove();
        marks.delete(key(row, name));
        continue;
      }
      const mark = token ?? make(row, name);
      place(mark, seat(block, index, rows.length));
      mark.dataset.status = row.status;
      mark.classList.toggle("chosen", row === picked);
    }
    countRest(name, block, rows.length);
  };
  const countRest = (name, block, count) => {
    let rest = more.get(name);
    if (count <= SEATS) {
      rest?.remove();
      more.delete(name);
      return;
    }
    if (!rest) {
      rest = h("span", { class: "m-token rest" });
      more.set(name, rest);
      layer.append(rest);
    }
    rest.textContent = `+${count - SEATS}`;
    place(rest, seat(block, SEATS, count));
  };

  // moves: [{row, from: [names], to: [names], ways: Map of name -> edges}]
  const move = (moves, missions) => {
    const lively = missions <= FOLLOWED && !still.matches;
    layer.classList.toggle("lively", lively);
    const touched = new Set();
    for (const { row, from, to } of moves) {
      for (const name of from) {
        const rows = here.get(name);
        rows.splice(rows.findIndex((each) => each.name === row.name), 1);
        touched.add(name);
        if (to.includes(name)) continue;
        const token = marks.get(key(row, name));
        token?.remove();
        marks.delete(key(row, name));
      }
      for (const name of to) {
        here.get(name).push(row);
        touched.add(name);
      }
    }
    for (const name of touched) arrange(name);
    if (document.hidden || !lively) return;
    for (const { row, ways } of moves) {
      for (const [name, edges] of ways) glide(marks.get(key(row, name)), edges);
    }
  };
  const glide = (token, edges) => {
    if (!token || !edges.length) return;
    const half = SIZE / 2;
    const along = edges.flatMap((edge) => edge.points).map(([x, y]) => [x - half, y - half]);
    const frames = [...keyframes(along), { transform: token.style.transform }];
    frames.forEach((frame) => frame.offset !== undefined && (frame.offset *= 0.85));
    token.animate(frames, { duration: TIME + 150 * edges.length, easing: "ease-in-out" });
  };
  const clear = () => {
    for (const rows of here.values()) rows.length = 0;
    for (const each of [marks, more]) each.clear();
    layer.replaceChildren();
  };
  const highlight = (name) => {
    for (const [block, rows] of here) if (rows.some((row) => row.name === name)) arrange(block);
  };
  const at = (name) => here.get(name);
  return { move, clear, highlight, at };
}
