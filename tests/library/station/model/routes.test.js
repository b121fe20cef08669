import assert from "node:assert/strict";
import { test } from "node:test";
import { apart, HEIGHT, inPort, lanes, portAt, route, widthOf } from "../../../../runtime/pluto_fleet/station/pages/monitor/routes.js";

/** @param {number} x @param {number} y */
const block = (x, y, emits = /** @type {string[]} */ ([])) => ({ x, y, emits });

/** The blocks that a way of straight pieces runs through. @param {readonly (readonly [number, number])[]} points @param {ReturnType<typeof block>[]} nodes */
const through = (points, nodes) => nodes.filter(({ x, y }) => points.slice(1).some(([toX, toY], i) => {
  const [fromX, fromY] = points[i];
  return Math.max(fromX, toX) > x && Math.min(fromX, toX) < x + widthOf({}) && Math.max(fromY, toY) > y && Math.min(fromY, toY) < y + HEIGHT;
}));

test("an edge to the next layer is a curve from its port", () => {
  const [from, to] = [block(0, 0, ["COMPLETED", "FAILED"]), block(224, 120)];
  const { d, points } = route(from, "FAILED", to, [from, to]);
  assert.deepEqual([points[0], points.at(-1)], [portAt(from, "FAILED"), inPort(to)]);
  assert.match(d, /^M112 52C/);
});

test("an edge goes around what stands between, and back beside all that it passes", () => {
  const chain = [0, 120, 240, 360].map((y) => block(0, y));
  for (const [from, to] of [[0, 2], [0, 3], [3, 0], [2, 1], [1, 1]]) {
    const { points } = route(chain[from], "all", chain[to], chain);
    assert.deepEqual(through(points, chain.filter((_, i) => i !== from && i !== to)), []);
  }
});

test("edges of one way have a lane each", () => {
  const nodes = new Map(Object.entries({ a: block(0, 0), b: block(0, 120) }));
  const edges = ["a b", "a b", "b a", "a a"].map((way) => way.split(" ")).map(([source, target]) => ({ source, target }));
  assert.deepEqual(lanes(edges, nodes), [0, 1, 0, 1]);
});

test("what edges say is moved down until nothing covers another", () => {
  const labels = [40, 0, 10, 45].map((y) => ({ middle: /** @type {const} */ ([0, y]), tall: 26 }));
  apart(labels);
  const at = labels.map(({ middle: [, y] }) => y).sort((a, b) => a - b);
  assert.ok(at.slice(1).every((y, i) => y - at[i] >= 26));
});
