// Simulate the app here, and see its missions move through the graph; back and forth in time.

import { refused, say } from "../announce.js";
import { elementOf, light } from "../canvas/blocks.js";
import { lightEdges } from "../canvas/wires.js";
import { fill, h, icon, keyed, many, put, set, shown, signButton, status, still } from "../dom.js";
import { showDialog } from "../dialogs/dialog.js";
import { ask } from "../link.js";
import { END, app, changed, isEnd, keyOf, outOf } from "../state.js";
import { typedAll } from "../text/pane.js";

const SHOWS = 12; // seconds in which a whole run is played
const FRESH = 0.03; // the part of a run for which an edge stays lit
const HOPS = 0.5; // the part of it that is for moves, of which many are at one instant; the rest is for time
const LINES = 60; // of what happened, up to now
const KILLED = 128; // exits above are signals: it did not end by itself

let run = null; // { events: [[time, mission, block, status, branch]], missions, duration_s, plan, log, exit }
let place = 0; // in the run, from 0 to 1
let playing = 0;

const slider = h("input", { type: "range", min: 0, max: 1000, value: 0, "aria-label": "Time of the run", oninput: () => { stop(); seek(slider.value / 1000); } });
const clock = h("output", { class: "clock" }, "0 s");
const play = h("button", { type: "button", class: "button primary", onclick: () => (playing ? stop() : start()) }, icon("play"), h("span", {}, "Play"));
const list = h("ul", { class: "run-missions", "aria-label": "Missions" });
const result = h("p", { class: "run-result", role: "status" });
const log = h("ol", { class: "run-log", tabIndex: 0, "aria-label": "What happened" });
const controls = h("div", { class: "run-controls", hidden: true },
  signButton("Back to the start", () => { stop(); seek(0); }, "back"), play, slider, clock);
const empty = h("p", { class: "none" }, icon("play"), h("span", {}, "Run the app to see its missions move through the graph."));
const seed = h("input", { type: "number", min: 0, value: 1, id: "run-seed" });

export function makeRun() {
  changed.heard(({ file }) => { if (run && file !== "layout") forget("The app has changed since it was run."); });
  return h("div", { class: "run" }, empty, controls, result, h("div", { class: "run-split" }, list, log));
}

export const seedField = () => h("div", { class: "row small" }, h("label", { for: "run-seed" }, "Seed"), seed);

const minutes = (seconds) => (seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`);

function forget(why) {
  stop();
  run = null;
  put(result, why);
  shown(controls, false);
  fill(list);
  fill(log);
  light(new Set());
  lightEdges(new Set());
  clearTokens();
}

export async function simulate() {
  forget("");
  shown(empty, true);
  put(empty.lastChild, "Compiling and simulating …");
  try {
    await typedAll();
    run = await ask("run", { missions: null, seed: Number(seed.value) });
  } catch (error) {
    put(empty.lastChild, "Run the app to see its missions move through the graph.");
    return refused(error);
  }
  shown(empty, false);
  shown(controls, true);
  if (!run.events.length) {
    fill(result, "It was not flown.", h("pre", { tabIndex: 0 }, run.log));
    shown(controls, false);
    return say("It was not flown.");
  }
  const ended = run.events.filter(([, , block, status_]) => block === END && status_ === "COMPLETED");
  const done = new Set(ended.map(([, mission]) => mission)).size;
  const words = `${done} of ${many(run.missions.length, "mission")} completed in ${minutes(run.duration_s)}.`;
  fill(result, h("span", {}, words), run.cut && " Only its first part is counted and shown.",
    run.exit > KILLED && " It was ended before it was over.",
    run.plan ? h("button", { type: "button", class: "link", onclick: showPlan }, "The missions were made up") : ` From ${run.file}.`,
    h("button", { type: "button", class: "link", onclick: showLog }, "What it printed"));
  say(words);
  run.places = placesOf(run);
  seek(0);
  if (still()) seek(1);
  else start();
  play.focus();
  return run;
}

function start() {
  if (!run) return;
  if (place >= 1) seek(0);
  put(play.lastChild, "Pause");
  play.firstChild.replaceWith(icon("pause"));
  let last = performance.now();
  const step = (now) => {
    seek(Math.min(1, place + (now - last) / 1000 / SHOWS));
    last = now;
    if (place >= 1) stop();
    else playing = requestAnimationFrame(step);
  };
  playing = requestAnimationFrame(step);
}

function stop() {
  cancelAnimationFrame(playing);
  playing = 0;
  put(play.lastChild, "Play");
  play.firstChild.replaceWith(icon("play"));
}

const showPlan = () => showDialog({ title: "Missions made up for this run", kind: "wide", content: [
  h("p", { class: "hint" }, "There is no missions.toml beside the app: with one, its missions are flown."),
  h("pre", {}, run.plan)] });
const showLog = () => showDialog({ title: "What the run printed", kind: "wide", content: h("pre", {}, run.log) });

// Where in the run each event is: moves at one instant are one after the other.
function placesOf({ events, duration_s: all }) {
  let [here, before] = [0, 0];
  return events.map(([t]) => {
    here += HOPS / events.length + (1 - HOPS) * (t - before) / (all || 1);
    before = t;
    return here;
  });
}

function timeAt(to, passed) {
  const before = passed ? run.events[passed - 1][0] : 0;
  const next = run.events[passed]?.[0] ?? run.duration_s;
  const since = (to - (passed ? run.places[passed - 1] : 0)) / (1 - HOPS) * run.duration_s;
  return Math.min(next, before + since);
}

// Where every mission is then. A fork's branches are shown one by one, until their gate.
function seek(to) {
  place = to;
  slider.value = Math.round(to * 1000);
  const at = new Map(run.missions.map((name) => [name, new Map()]));
  const keys = new Set();
  let passed = 0;
  for (const [, mission, block, status_, branch] of run.events) {
    if (run.places[passed] > to + 1e-9) break;
    const branches = at.get(mission);
    const fresh = to - run.places[passed] <= FRESH;
    passed += 1;
    for (const [other, there] of branches) {
      const edge = other <= branch && (fresh || other < branch)
        && outOf(there.block).find((one) => one.target === block);
      if (edge && fresh) keys.add(keyOf(edge));
      if (edge && other < branch) there.forked = true;
      if (other > branch && (app.nodes.get(block)?.gate || block === END)) branches.delete(other);
    }
    branches.set(branch, { block, status: status_, forked: false });
  }
  const now = minutes(timeAt(to, passed));
  set(slider, "aria-valuetext", now);
  put(clock, `${now} of ${minutes(run.duration_s)}`);
  lightEdges(keys);
  drawTokens(at);
  drawMissions(at);
  drawLog(passed);
}

const shownOf = (branches) => [...branches.values()].filter((one) => !one.forked);

function clearTokens() {
  for (const token of document.querySelectorAll(".block .token")) token.remove();
}

function drawTokens(at) {
  const tokens = new Map();
  run.missions.forEach((mission, i) => {
    for (const { block, status: status_ } of shownOf(at.get(mission))) {
      if (!tokens.has(block)) tokens.set(block, []);
      tokens.get(block).push([i + 1, status_, mission]);
    }
  });
  for (const name of app.nodes.keys()) {
    const host = elementOf(name).querySelector(".tokens");
    const own = tokens.get(name) ?? [];
    const key = own.join();
    if (host.dataset.shown === key && host.childElementCount === own.length) continue;
    host.dataset.shown = key;
    host.replaceChildren(...own.map(([number, status_, mission]) =>
      h("span", { class: "token", "data-status": status_, title: `${mission}: ${status_}` }, number)));
  }
}

function drawMissions(at) {
  keyed(list, run.missions, (name) => name, (name) => h("li", {},
    h("span", { class: "token" }, run.missions.indexOf(name) + 1), h("strong", {}, name), h("span", { class: "hint where" }), h("span", { class: "now" })),
  (item, name) => {
    const here = shownOf(at.get(name));
    const blocks = here.map(({ block }) => block).join(" and ");
    put(item.querySelector(".where"), !here.length ? "not begun" : isEnd(blocks) ? "at the end" : `in ${blocks}`);
    const now = item.querySelector(".now");
    const standing = here[0]?.status ?? "";
    if (now.dataset.status === standing) return;
    now.dataset.status = standing;
    fill(now, standing && status(standing));
    set(item.firstChild, "data-status", standing || null);
  });
}

function drawLog(passed) {
  const from = Math.max(0, passed - LINES);
  keyed(log, run.events.slice(from, passed).map((event, i) => ({ event, i: from + i })), ({ i }) => i,
    ({ event: [t, mission, block, status_], i }) => h("li", {},
      h("button", { type: "button", class: "log-line", tabIndex: -1, onclick: () => { stop(); seek(run.places[i]); } },
        h("span", { class: "when" }, minutes(t)), h("strong", {}, mission), block, status(status_))));
  log.scrollTop = log.scrollHeight;
}
