// By which edges a mission came where it is now. Pure.

/**
 * Return the function that finds the edges of the shortest way from one of the blocks `from`, left with a
 * status, to the block `to`, reached with the final one; none where no way fits, so that nothing is
 * lit that cannot have been. Any block but a gate can turn what comes into the final status.
 * @param {Pick<GraphShape, "blocks" | "edges">} graph
 * @returns {(from: string[], status: string, to: string, final: string) => EdgeShape[]}
 */
export function wayFinder({ blocks, edges }) {
  const gates = new Set(blocks.filter(({ gate }) => gate).map(({ name }) => name));
  return (from, status, to, final) => {
    /** @type {Map<string, { block: string, status: string, way: EdgeShape[] }>} */
    const found = new Map(from.map((block) => [`${block} ${status}`, { block, status, way: [] }]));
    for (const { block, status: now, way } of found.values()) { // it grows: the nearest come first
      for (const edge of edges) {
        if (edge.source !== block || !edge.statuses.includes(now)) continue;
        if (edge.target === to && now === final) return [...way, edge];
        for (const next of gates.has(edge.target) ? [now] : [now, final]) {
          const key = `${edge.target} ${next}`;
          if (!found.has(key)) found.set(key, { block: edge.target, status: next, way: [...way, edge] });
        }
      }
    }
    return [];
  };
}

/** With which status a mission left where it was: what came of its trip, if it flew one. @param {MissionRow} before @param {MissionRow} row */
export function leftWith(before, row) {
  if (before.status !== "RUNNING") return before.status;
  if (row.status === "FAILED" || row.attempt > before.attempt) return "FAILED";
  return row.round > before.round || before.done + 1 >= before.total ? "COMPLETED" : "STANDBY";
}

/** The blocks at which a mission is; one that has not begun stands at the start. @param {MissionRow} row @param {ReadonlySet<string>} known */
export function blocksOf({ at, status }, known) {
  const here = at.filter((name) => known.has(name));
  if (here.length || !known.has("start")) return here;
  if (status === "UNEXECUTED") return ["start"];
  return ["COMPLETED", "FAILED", "CANCELLED"].includes(status) ? ["end"] : here;
}
