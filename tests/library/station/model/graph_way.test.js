import assert from "node:assert/strict";
import { test } from "node:test";
import { wayFinder } from "../../../../runtime/pluto_fleet/station/pages/monitor/graph_way.js";

/** The graph of the example alfalfa, by its blocks and its edges with the statuses that pass. */
const BLOCKS = ["wait", "allocate", "launch", "watch", "timer", "first", "judge", "again", "retry"];
const EDGES = [
  ["wait", "allocate", "STANDBY UNEXECUTED"],
  ["allocate", "launch", "STANDBY UNEXECUTED"],
  ["launch", "watch", "RUNNING"],
  ["launch", "timer", "RUNNING"],
  ["watch", "first", "STANDBY COMPLETED FAILED"],
  ["timer", "first", "STANDBY COMPLETED FAILED"],
  ["first", "allocate", "STANDBY"],
  ["first", "judge", "COMPLETED"],
  ["first", "retry", "FAILED"],
  ["judge", "allocate", "STANDBY"],
  ["judge", "again", "COMPLETED"],
  ["again", "wait", "STANDBY"],
  ["again", "end", "COMPLETED"],
  ["retry", "allocate", "STANDBY"],
  ["retry", "end", "FAILED"],
];
const GRAPH = {
  blocks: BLOCKS.map((name) => ({ name, gate: name === "first" })),
  edges: EDGES.map(([source, target, statuses]) => ({ source, target, statuses: statuses.split(" ") })),
};

test("only edges are lit that the mission can have taken, though it is seen ten times a second only", () => {
  const way = wayFinder(/** @type {any} */ (GRAPH));
  const expected = [
    ["COMPLETED", "end", "COMPLETED", "first judge again end"],
    ["COMPLETED", "allocate", "STANDBY", "first judge allocate"],
    ["COMPLETED", "wait", "STANDBY", "first judge again wait"],
    ["STANDBY", "allocate", "STANDBY", "first allocate"],
    ["FAILED", "allocate", "STANDBY", "first retry allocate"],
    ["FAILED", "end", "FAILED", "first retry end"],
    ["STANDBY", "end", "CANCELLED", ""],
  ];
  for (const [status, to, final, blocks] of expected) {
    assert.equal(way(["watch", "timer"], status, to, final).map(({ target }) => target).join(" "), blocks);
  }
});
