// The lines of a graph's edges, in the station and in plutoc's editor: pure geometry. Down a curve; up,
// or where a block is in between, a path with round corners through the nearest free corridor at the side.

/** @typedef {{ x: number, y: number, terminal?: boolean, emits: string[] }} Node a block, by its upper left corner */
/** @typedef {readonly [number, number]} Spot */
/** @typedef {{ d: string, middle: Spot, points: Spot[] }} Way */

export const WIDTH = 176;
export const HEIGHT = 52;
const END_WIDTH = 96; // of start and end
const CLEAR = 46; // between a wire and blocks: half of what it says of statuses
const LANE = 14; // between wires in one corridor
const RADIUS = 12;
const STUB = 20; // straight out of a block, and into one
const SLOT = 24; // between ports
const LABEL = 84; // the width of what a wire says

/** @param {Pick<Node, "terminal">} node */
export const widthOf = (node) => (node.terminal ? END_WIDTH : WIDTH);

/** Along the lower edge: the statuses in their order, the port of all in the middle. @param {string[]} emits */
export const slots = (emits) => emits.toSpliced(Math.floor(emits.length / 2), 0, "all");

/** @param {Node} node @param {string} port @returns {Spot} */
export function portAt(node, port) {
  const all = node.terminal ? ["all"] : slots(node.emits);
  const middle = all.indexOf("all");
  const i = all.indexOf(port);
  return [node.x + widthOf(node) / 2 + SLOT * ((i < 0 ? middle : i) - middle), node.y + HEIGHT];
}

/** @param {Node} node @returns {Spot} */
export const inPort = (node) => [node.x + widthOf(node) / 2, node.y];

/**
 * For each edge how many before it take the same way: between the same two blocks, or back into the same one.
 * @param {readonly { source: string, target: string }[]} edges @param {ReadonlyMap<string, Node>} nodes
 */
export function lanes(edges, nodes) {
  /** @type {Map<string, number>} */
  const ways = new Map();
  return edges.map(({ source, target }) => {
    const back = node(nodes, target).y - node(nodes, source).y < HEIGHT + STUB;
    const way = back ? `back ${target}` : `${source} ${target}`;
    const lane = ways.get(way) ?? 0;
    ways.set(way, lane + 1);
    return lane;
  });
}

/** @param {ReadonlyMap<string, Node>} nodes @param {string} name */
const node = (nodes, name) => /** @type {Node} */ (nodes.get(name));

/**
 * The line from a port of one block to another block.
 * @param {Node} source @param {string} port @param {Node} target @param {readonly Node[]} nodes @returns {Way}
 */
export function route(source, port, target, nodes, lane = 0) {
  const [sx, sy] = portAt(source, port);
  const [tx, ty] = inPort(target);
  const down = ty - sy >= STUB;
  if (down && lane === 0) {
    const bend = Math.max(22, (ty - sy) / 2);
    /** @type {Spot[]} */
    const curve = [[sx, sy], [sx, sy + bend], [tx, ty - bend], [tx, ty]];
    if (!blocked(curve, nodes, source, target)) return curved(curve);
  }
  const top = down ? sy : Math.min(source.y, target.y);
  const bottom = down ? ty : Math.max(sy, target.y + HEIGHT) + STUB;
  const left = corridor(top, bottom, Math.min(source.x, target.x), -1, nodes) - lane * LANE;
  const right = corridor(top, bottom,
    Math.max(source.x + widthOf(source), target.x + widthOf(target)), 1, nodes) + lane * LANE;
  const x = sx - left + Math.abs(tx - left) <= right - sx + Math.abs(right - tx) ? left : right;
  if (down) {
    const out = sy + STUB / 2 + 4;
    return angled([[sx, sy], [sx, out], [x, out], [x, ty - STUB], [tx, ty - STUB], [tx, ty]]);
  }
  const side = x < tx ? target.x : target.x + widthOf(target);
  const height = target.y + HEIGHT / 2 + Math.min(lane, 2) * 9;
  return angled([[sx, sy], [sx, sy + STUB], [x, sy + STUB], [x, height], [side, height]]);
}

/**
 * The nearest place at a side at which no block is in the way.
 * @param {number} from @param {number} to @param {number} start @param {1 | -1} sign @param {readonly Node[]} nodes
 */
function corridor(from, to, start, sign, nodes) {
  const near = nodes.filter(({ y }) => y < to + 4 && y + HEIGHT > from - 4)
    .sort((a, b) => sign * (a.x - b.x));
  let x = start + sign * CLEAR;
  for (const one of near) {
    const [low, high] = [one.x - CLEAR, one.x + widthOf(one) + CLEAR];
    if (x > low + 4 && x < high - 4) x = sign < 0 ? low : high;
  }
  return x;
}

/** A point of a Bézier curve. @param {readonly Spot[]} curve @param {number} t @returns {Spot} */
function at([a, b, c, d], t) {
  const u = 1 - t;
  const along = (/** @type {0 | 1} */ i) =>
    u * u * u * a[i] + 3 * u * u * t * b[i] + 3 * u * t * t * c[i] + t * t * t * d[i];
  return [along(0), along(1)];
}

/** @param {readonly Spot[]} curve @param {readonly Node[]} nodes @param {Node} source @param {Node} target */
function blocked(curve, nodes, source, target) {
  const [from, to] = [curve[0][1], curve[3][1]];
  const between = nodes.filter((one) => one !== source && one !== target
    && one.y < to && one.y + HEIGHT > from);
  if (!between.length) return false;
  for (let t = 0.05; t < 1; t += 0.05) {
    const [x, y] = at(curve, t);
    if (between.some((one) => x > one.x - 4 && x < one.x + widthOf(one) + 4
      && y > one.y - 4 && y < one.y + HEIGHT + 4)) return true;
  }
  return false;
}

/** @param {Spot} spot */
const written = ([x, y]) => `${Math.round(x)} ${Math.round(y)}`;

/** @param {Spot[]} points @returns {Way} */
function curved(points) {
  const [a, b, c, d] = points.map(written);
  return { d: `M${a}C${b} ${c} ${d}`, middle: at(points, 0.5), points };
}

/** @param {Spot[]} points @returns {Way} */
function angled(points) {
  let d = `M${written(points[0])}`;
  /** @type {[number, Spot]} */
  let longest = [-1, points[0]];
  for (let i = 1; i < points.length; i += 1) {
    const [here, to, next] = [points[i - 1], points[i], points[i + 1]];
    const length = Math.hypot(to[0] - here[0], to[1] - here[1]);
    if (length > longest[0] && here[0] === to[0]) {
      longest = [length, [to[0], (here[1] + to[1]) / 2]];
    }
    if (!next) return { d: `${d}L${written(to)}`, middle: longest[1], points };
    const after = Math.hypot(next[0] - to[0], next[1] - to[1]);
    const round = Math.min(RADIUS, length / 2, after / 2);
    /** @param {Spot} other @param {number} far @returns {Spot} */
    const toward = (other, far) => [
      to[0] + (other[0] - to[0]) * round / (far || 1), to[1] + (other[1] - to[1]) * round / (far || 1)];
    d += `L${written(toward(here, length))}Q${written(to)} ${written(toward(next, after))}`;
  }
  throw new Error("a way has two points");
}

/** What wires say, moved down a little where one would cover another. @param {{ middle: Spot, tall: number }[]} labels */
export function apart(labels) {
  /** @type {{ x: number, y: number, tall: number }[]} */
  const taken = [];
  for (const label of labels.toSorted((a, b) => a.middle[1] - b.middle[1])) {
    const { middle: [x], tall } = label;
    let { middle: [, y] } = label;
    for (const other of taken) {
      const both = (other.tall + tall) / 2;
      if (Math.abs(other.x - x) < LABEL && Math.abs(other.y - y) < both) y = other.y + both;
    }
    taken.push({ x, y, tall });
    label.middle = [x, y];
  }
}
