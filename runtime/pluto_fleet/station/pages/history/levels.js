// The levels of batteries over a flight, as lines of a chart. Pure.

const MOST = 300; // points of a line: more cannot be seen

/** @typedef {{ drone: string, points: string, lowest: number }} Line points as SVG has them: time over its length, level from the top */

/** The lowest of every few pairs, so that a dip is never left out. @param {readonly (readonly number[])[]} pairs */
function thinned(pairs) {
  const every = Math.ceil(pairs.length / MOST);
  if (every <= 1) return pairs;
  /** @type {(readonly number[])[]} */
  const kept = [];
  for (let at = 0; at < pairs.length; at += every) {
    kept.push(pairs.slice(at, at + every).reduce((low, pair) => (pair[1] < low[1] ? pair : low)));
  }
  return kept;
}

/** @param {Record<string, readonly (readonly number[])[]>} batteries of each drone pairs of time and level @param {number} seconds @returns {Line[]} */
export function linesOf(batteries, seconds) {
  return Object.entries(batteries).filter(([, pairs]) => pairs.length).map(([drone, pairs]) => ({
    drone,
    lowest: Math.min(...pairs.map(([, level]) => level)),
    points: thinned(pairs).map(([time, level]) =>
      `${((time / (seconds || 1)) * 1000).toFixed(1)},${((1 - level) * 100).toFixed(1)}`).join(" "),
  })).toSorted((a, b) => a.drone.localeCompare(b.drone, undefined, { numeric: true }));
}
