// Ways through the app's graph, as numbers: which edges a mission took from one block to another.
// Nothing here knows of the page.

export const START = "start";
export const END = "end";

// finder(edges)(from, to): the edges of the shortest way from any of the blocks `from` to `to`,
// [] where there is none.
export function finder(edges) {
  const leaving = new Map();
  for (const edge of edges) {
    if (!leaving.has(edge.from)) leaving.set(edge.from, []);
    leaving.get(edge.from).push(edge);
  }
  const known = new Map();
  const search = (from, to) => {
    const came = new Map(from.map((block) => [block, null]));
    let reached = [...from];
    while (reached.length) {
      const next = [];
      for (const block of reached) {
        for (const edge of leaving.get(block) ?? []) {
          if (edge.to === to) return back(came, edge);
          if (came.has(edge.to)) continue;
          came.set(edge.to, edge);
          next.push(edge.to);
        }
      }
      reached = next;
    }
    return [];
  };
  return (from, to) => {
    const key = `${from.join(" ")} > ${to}`;
    if (!known.has(key)) known.set(key, search(from, to));
    return known.get(key);
  };
}

function back(came, last) {
  const way = [];
  for (let edge = last; edge; edge = came.get(edge.from)) way.unshift(edge);
  return way;
}

// The path of an edge with its corners rounded, for an SVG path.
export function rounded(points, radius = 8) {
  const [first, ...rest] = points;
  let path = `M${first[0]} ${first[1]}`;
  rest.forEach((corner, index) => {
    const before = points[index];
    const after = points[index + 2];
    if (!after) {
      path += `L${corner[0]} ${corner[1]}`;
      return;
    }
    const [a, b] = [toward(corner, before, radius), toward(corner, after, radius)];
    path += `L${a[0]} ${a[1]}Q${corner[0]} ${corner[1]} ${b[0]} ${b[1]}`;
  });
  return path;
}

function toward(from, to, far) {
  const length = distance(from, to) || 1;
  const part = Math.min(far, length / 2) / length;
  return [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part];
}

export const distance = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);

// Where along its points an edge's words can stand: the middle of its longest piece.
export function middle(points) {
  let best = [points[0], points[1]];
  points.slice(1).forEach((point, index) => {
    const piece = [points[index], point];
    if (distance(...piece) > distance(...best)) best = piece;
  });
  return [(best[0][0] + best[1][0]) / 2, (best[0][1] + best[1][1]) / 2];
}

// Keyframes of a token that moves evenly along these points.
export function keyframes(points) {
  const lengths = points.slice(1).map((point, index) => distance(points[index], point));
  const whole = lengths.reduce((sum, length) => sum + length, 0) || 1;
  let far = 0;
  return points.map(([x, y], index) => {
    far += index ? lengths[index - 1] : 0;
    return { transform: `translate(${x}px, ${y}px)`, offset: Math.min(1, far / whole) };
  });
}
