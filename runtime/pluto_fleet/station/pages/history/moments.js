// What there was at an instant of a flight, of what is known of all of it: what had happened, and where what moves was. Pure.

/** How many of these stand before or at an instant; their times only grow. @template One @param {readonly One[]} all @param {number} t @param {(one: One) => number} timeOf */
export function countUntil(all, t, timeOf) {
  let [low, high] = [0, all.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (timeOf(all[middle]) <= t) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** What had happened, with what was decided of it by then. @param {readonly EventRow[]} events @param {number} t @returns {EventRow[]} */
export const eventsAt = (events, t) => events.slice(0, countUntil(events, t, ({ time }) => time)).map((row) =>
  (row.over !== null && row.over > t ? { ...row, made: [], broke_off: [], why: "", over: null } : row));

const KEPT = 60; // seconds of a trail, and for which something is shown that was not reported any more
const APART = 3; // seconds between two reports between which something has gone straight on

/** Where something was that was reported before, and perhaps after. @param {Point} before @param {Point | undefined} after @param {number} t @returns {Point} */
function placed(before, after, t) {
  if (!after || after[0] - before[0] > APART) return before;
  const part = (t - before[0]) / (after[0] - before[0]);
  return before.map((value, at) => value + part * (after[at] - value));
}

/** What was tracked. @param {readonly TrackWay[]} ways @param {number} t @returns {TrackRow[]} */
export function tracksAt(ways, t) {
  return ways.flatMap(({ id, kind, way }) => {
    const count = countUntil(way, t, ([time]) => time);
    if (!count || t - way[count - 1][0] > KEPT) return [];
    const [seen, x, y, z] = placed(way[count - 1], way[count], t);
    const first = countUntil(way, t - KEPT, ([time]) => time);
    return [{ id, kind, x, y, z, seen, trail: way.slice(first, count).map(([, px, py]) => [px, py]) }];
  });
}
