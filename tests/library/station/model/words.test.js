// What Start would do, and why it waits.

import "./browser.js";
import assert from "node:assert/strict";
import { test } from "node:test";

const { startWords } = await import("../../../../runtime/pluto_fleet/station/pages/start/words.js");

/** @param {object} [more] @returns {any} */
const state = (more) => ({ known: true, phase: "idle", time: 0, plan: 1, map: 0, said: "", how: null, busy: "", ...more });
/** @param {string} key @param {object} [more] @returns {any} */
const mission = (key, more) => ({ key, name: key, launched: false, ended: null, trips: [{ key: `${key}1` }], ...more });
/** @param {any[]} missions @param {any[]} [problems] */
const plan = (missions, problems = []) => ({ missions, problems, isLoaded: true });

test("what has not been completed is started", () => {
  const words = startWords(state(), plan([mission("a"), mission("b", { ended: "COMPLETED" })]), [], true);
  assert.equal(words.text, "Start 1 mission");
  assert.equal(words.can, true);
  assert.equal(words.said, "Start leaves out what was completed.");
});

test("once all are completed, all are started again", () => {
  const words = startWords(state({ phase: "over" }), plan([mission("a", { ended: "COMPLETED" })]), [], true);
  assert.equal(words.can, true);
  assert.equal(words.said, "All are completed: Start flies them all again.");
});

test("a problem keeps Start waiting, and is named with its mission and trip", () => {
  const problem = { mission: "a", trip: "a1", field: "target", text: "Outside the map." };
  const words = startWords(state(), plan([mission("a")], [problem]), [], true);
  assert.equal(words.can, false);
  assert.equal(words.said, "a, trip 1: Outside the map.");
  assert.equal(words.problem, problem);
});

test("a problem of a mission that is not started does not matter", () => {
  const problem = { mission: "b", trip: null, field: "name", text: "No name." };
  const missions = [mission("a"), mission("b", { ended: "COMPLETED" })];
  assert.equal(startWords(state(), plan(missions, [problem]), [], true).can, true);
});

test("a drone that is lost is named, and all lost keep Start waiting", () => {
  /** @type {any[]} */
  const drones = [{ id: "cf1", status: "LOST" }, { id: "cf2", status: "FREE" }];
  assert.equal(startWords(state(), plan([mission("a")]), drones, true).said, "Lost, and left out until brought back: cf1.");
  assert.equal(startWords(state(), plan([mission("a")]), drones.slice(0, 1), true).can, false);
});

test("until the station has spoken, and for those who only watch, nothing can be started", () => {
  assert.equal(startWords(state({ known: false }), plan([mission("a")]), [], true).can, false);
  assert.equal(startWords(state(), plan([mission("a")]), [], false).can, false);
});
