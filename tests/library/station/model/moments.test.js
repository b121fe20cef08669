// What there was at an instant of a flight: what had happened, and where what moves was.

import assert from "node:assert/strict";
import { test } from "node:test";
import { eventsAt, tracksAt } from "../../../../runtime/pluto_fleet/station/pages/history/moments.js";

/** @param {string} id @param {number} time @param {number | null} over @returns {any} */
const event = (id, time, over) => ({ id, time, over, made: ["Look"], broke_off: ["Patrol"], why: "" });

test("what has not happened yet is not there, and what is not decided yet is open", () => {
  const events = [event("a", 1, 1.5), event("b", 2, 4), event("c", 6, 6)];
  assert.deepEqual(eventsAt(events, 0.5), []);
  const [first, second, ...more] = eventsAt(events, 3);
  assert.equal(first, events[0]); // the very same: who has drawn it draws it no more
  assert.deepEqual([second.made, second.broke_off, second.over], [[], [], null]);
  assert.deepEqual(more, []);
});

/** It walks for three seconds, is not seen for twenty, and is somewhere else then. */
const WAY = [[10, 0, 0, 0], [11, 1, 0, 0], [12, 2, 0, 0], [13, 3, 0, 0], [33, 9, 9, 0], [34, 9, 8, 0]];
const at = (/** @type {number} */ t) => tracksAt([{ id: "t1", kind: "person", way: WAY }], t)[0];

test("between two reports it has gone straight on, and when none comes it is where it was seen last", () => {
  assert.equal(at(9.9), undefined);
  assert.deepEqual([at(11.5).x, at(11.5).seen], [1.5, 11.5]);
  assert.deepEqual([at(20).x, at(20).seen], [3, 13]);
  assert.deepEqual([at(33.5).y, at(33.5).seen], [8.5, 33.5]);
  assert.deepEqual([at(90).y, at(90).seen], [8, 34]);
  assert.equal(at(94.1), undefined);
});

test("its trail is where it was in the last minute", () => {
  assert.deepEqual(at(12).trail, [[0, 0], [1, 0], [2, 0]]);
  assert.deepEqual(at(72.5).trail, [[3, 0], [9, 9], [9, 8]]);
});
