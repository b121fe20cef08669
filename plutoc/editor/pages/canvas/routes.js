// The ways of wires: pure geometry. Down a curve; up, or where a block is in between, a path with
// round corners through the nearest free corridor at the side.

import { HEIGHT, widthOf } from "../state.js";

const CLEAR = 46; // between a wire and blocks: half of what it says of statuses
const LANE = 14; // between wires in one corridor
const RADIUS = 12;
const STUB = 20; // straight out of a block, and into one
const SLOT = 24; // between ports

// Along the lower edge: the statuses in their order, the port of all in the middle.
export const slots = (emits) => {
  const before = Math.floor(emits.length / 2);
  return [...emits.slice(0, before), "all", ...emits.slice(before)];
};

export function portAt(node, port) {
  const all = node.terminal ? ["all"] : slots(node.emits);
  const middle = all.indexOf("all");
  const i = all.indexOf(port);
  return [node.x + widthOf(node) / 2 + SLOT * ((i < 0 ? middle : i) - middle), node.y + HEIGHT];
}

export const inPort = (node) => [node.x + widthOf(node) / 2, node.y];

const portOf = ({ when, otherwise, statuses }) => {
  if (when.length === 1) return when[0];
  return otherwise && statuses.length === 1 ? statuses[0] : "all";
};

// → { d, middle, ends: [[x, y], [x, y]] }; lane: how many wires of this way are there already.
export function route(source, target, edge, nodes, lane = 0) {
  const [sx, sy] = portAt(source, portOf(edge));
  const [tx, ty] = inPort(target);
  if (ty - sy >= STUB) {
    const bend = Math.max(22, (ty - sy) / 2);
    const curve = [[sx, sy], [sx, sy + bend], [tx, ty - bend], [tx, ty]];
    if (lane === 0 && !blocked(curve, nodes, source, target)) return curved(curve);
    const left = corridor(sy, ty, Math.min(source.x, target.x, sx, tx), -1, nodes) - lane * LANE;
    const right = corridor(sy, ty, Math.max(source.x + widthOf(source), target.x + widthOf(target)), 1, nodes)
      + lane * LANE;
    const x = cheaper(left, right, sx, tx);
    return angled([[sx, sy], [sx, sy + STUB / 2 + 4], [x, sy + STUB / 2 + 4], [x, ty - STUB],
      [tx, ty - STUB], [tx, ty]]);
  }
  const top = Math.min(source.y, target.y);
  const bottom = Math.max(sy, target.y + HEIGHT) + STUB;
  const left = corridor(top, bottom, Math.min(source.x, target.x), -1, nodes) - lane * LANE;
  const right = corridor(top, bottom,
    Math.max(source.x + widthOf(source), target.x + widthOf(target)), 1, nodes) + lane * LANE;
  const x = cheaper(left, right, sx, tx);
  const side = x < tx ? target.x : target.x + widthOf(target);
  const height = target.y + HEIGHT / 2 + Math.min(lane, 2) * 9;
  return angled([[sx, sy], [sx, sy + STUB], [x, sy + STUB], [x, height], [side, height]]);
}

const cheaper = (left, right, sx, tx) =>
  (sx - left + Math.abs(tx - left) <= right - sx + Math.abs(right - tx) ? left : right);

// The nearest place at a side at which no block is in the way.
function corridor(from, to, start, sign, nodes) {
  const near = nodes.filter((node) => node.y < to + 4 && node.y + HEIGHT > from - 4)
    .sort((a, b) => sign * (a.x - b.x));
  let x = start + sign * CLEAR;
  for (const node of near) {
    const [low, high] = [node.x - CLEAR, node.x + widthOf(node) + CLEAR];
    if (x > low + 4 && x < high - 4) x = sign < 0 ? low : high;
  }
  return x;
}

function at([a, b, c, d], t) {
  const u = 1 - t;
  return [0, 1].map((i) =>
    u * u * u * a[i] + 3 * u * u * t * b[i] + 3 * u * t * t * c[i] + t * t * t * d[i]);
}

function blocked(curve, nodes, source, target) {
  const [from, to] = [curve[0][1], curve[3][1]];
  const between = nodes.filter((node) => node !== source && node !== target
    && node.y < to && node.y + HEIGHT > from);
  if (!between.length) return false;
  for (let t = 0.05; t < 1; t += 0.05) {
    const [x, y] = at(curve, t);
    if (between.some((node) => x > node.x - 4 && x < node.x + widthOf(node) + 4
      && y > node.y - 4 && y < node.y + HEIGHT + 4)) return true;
  }
  return false;
}

const r = Math.round;

function curved(curve) {
  const [a, b, c, d] = curve;
  return {
    d: `M${r(a[0])} ${r(a[1])}C${r(b[0])} ${r(b[1])} ${r(c[0])} ${r(c[1])} ${r(d[0])} ${r(d[1])}`,
    middle: at(curve, 0.5),
    ends: [a, d],
  };
}

function angled(points) {
  let d = `M${r(points[0][0])} ${r(points[0][1])}`;
  let longest = [-1, points[0]];
  for (let i = 1; i < points.length; i += 1) {
    const [here, to, next] = [points[i - 1], points[i], points[i + 1]];
    const length = Math.hypot(to[0] - here[0], to[1] - here[1]);
    if (length > longest[0] && here[0] === to[0]) {
      longest = [length, [to[0], (here[1] + to[1]) / 2]];
    }
    if (!next) {
      d += `L${r(to[0])} ${r(to[1])}`;
      break;
    }
    const after = Math.hypot(next[0] - to[0], next[1] - to[1]);
    const round = Math.min(RADIUS, length / 2, after / 2);
    const toward = (other, far) => [
      to[0] + (other[0] - to[0]) * round / (far || 1), to[1] + (other[1] - to[1]) * round / (far || 1)];
    const [before, behind] = [toward(here, length), toward(next, after)];
    d += `L${r(before[0])} ${r(before[1])}Q${r(to[0])} ${r(to[1])} ${r(behind[0])} ${r(behind[1])}`;
  }
  return { d, middle: longest[1], ends: [points[0], points.at(-1)] };
}

export const loose = ([ax, ay], [bx, by]) => {
  const bend = by > ay ? Math.max(24, (by - ay) / 2) : 48;
  return `M${r(ax)} ${r(ay)}C${r(ax)} ${r(ay + bend)} ${r(bx)} ${r(by - bend)} ${r(bx)} ${r(by)}`;
};
