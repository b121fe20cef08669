// Simulate the app here, and see its missions move through the graph; back and forth in time.

import { refused, say } from "../announce.js";
import { elementOf, light } from "../canvas/blocks.js";
import { lightEdges } from "../canvas/wires.js";
import { fill, h, icon, keyed, put, set, shown, signButton, status } from "../dom.js";
import { ask } from "../link.js";
import { app, changed, isEnd, keyOf, outOf } from "../state.js";
import { typedAll } from "../text/pane.js";

const SHOWS = 12; // seconds in which a whole run is played at speed 1
const FRESH = 0.04; // the part of a run for which an edge stays lit

let run = null; // { events, missions, duration_s, … }
let time = 0;
let playing = 0;

const slider = h("input", { type: "range", min: 0, max: 1000, value: 0, "aria-label": "Time of the run", oninput: () => { stop(); seek(slider.value / 1000 * run.duration_s); } });
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
  changed.heard(({ file }) => { if (run && file !== "layout") forget(); });
  return h("div", { class: "run" }, empty, controls, result, h("div", { class: "run-split" }, list, log));
}

export const seedField = () => h("div", { class: "row small" }, h("label", { for: "run-seed" }, "Seed"), seed);

const minutes = (seconds) => (seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`);

function forget() {
  stop();
  run = null;
  put(result, "The app has changed since it was run.");
  shown(controls, false);
  fill(list);
  fill(log);
  light(new Set());
  lightEdges(new Set());
  clearTokens();
}

export async function simulate() {
  stop();
  shown(empty, true);
  put(empty.lastChild, "Compiling and simulating …");
  put(result, "");
  shown(controls, false);
  try {
    await typedAll();
    run = await ask("run", { missions: null, seed: Number(seed.value) || 1 });
  } catch (error) {
    put(empty.lastChild, "Run the app to see its missions move through the graph.");
    return refused(error);
  }
  shown(empty, false);
  shown(controls, true);
  const names = run.missions.map((one) => one.name ?? one);
  const done = run.missions.filter((one) => one.status === "COMPLETED").length;
  put(result, `${done} of ${names.length} missions completed in ${minutes(run.duration_s)}. ${run.made_up ? "There is no missions.toml beside the app: these missions were made up." : ""}`);
  say(result.textContent);
  seek(0);
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) seek(run.duration_s);
  else start();
  play.focus();
  return run;
}

function start() {
  if (!run) return;
  if (time >= run.duration_s) seek(0);
  put(play.lastChild, "Pause");
  play.firstChild.replaceWith(icon("pause"));
  let last = performance.now();
  const step = (now) => {
    seek(Math.min(run.duration_s, time + (now - last) / 1000 * run.duration_s / SHOWS));
    last = now;
    if (time >= run.duration_s) stop();
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

// Where every mission is at a time: in the block that it entered last.
function seek(to) {
  time = to;
  slider.value = run.duration_s ? Math.round(to / run.duration_s * 1000) : 0;
  set(slider, "aria-valuetext", minutes(to));
  put(clock, `${minutes(to)} of ${minutes(run.duration_s)}`);
  const at = new Map();
  const keys = new Set();
  let passed = 0;
  for (const [t, mission, block, status_] of run.events) {
    if (t > to) break;
    passed += 1;
    const before = at.get(mission);
    if (before && to - t <= FRESH * run.duration_s) {
      const edge = outOf(before.block).find((one) => one.target === block);
      if (edge) keys.add(keyOf(edge));
    }
    at.set(mission, { block, status: status_ });
  }
  lightEdges(keys);
  drawTokens(at);
  drawMissions(at);
  drawLog(passed);
}

function nameList() {
  return run.missions.map((one) => one.name ?? one);
}

function clearTokens() {
  for (const token of document.querySelectorAll(".block .token")) token.remove();
}

function drawTokens(at) {
  const names = nameList();
  const tokens = new Map();
  for (const [mission, { block, status: status_ }] of at) {
    if (!tokens.has(block)) tokens.set(block, []);
    tokens.get(block).push([names.indexOf(mission) + 1, status_, mission]);
  }
  for (const name of app.nodes.keys()) {
    const host = elementOf(name).querySelector(".tokens");
    const own = tokens.get(name) ?? [];
    const key = own.join();
    if (host.dataset.shown === key && host.childElementCount === own.length) continue;
    host.dataset.shown = key;
    host.replaceChildren(...own.map(([number, status_, mission]) =>
      h("span", { class: "token", "data-status": status_, title: mission }, number)));
  }
}

function drawMissions(at) {
  keyed(list, nameList(), (name) => name, (name) => h("li", {},
    h("span", { class: "token" }, nameList().indexOf(name) + 1), h("strong", {}, name), h("span", { class: "hint where" }), h("span", { class: "now" })),
  (item, name) => {
    const here = at.get(name);
    put(item.querySelector(".where"), here ? isEnd(here.block) ? `at ${here.block}` : `in ${here.block}` : "not begun");
    const now = item.querySelector(".now");
    if (now.dataset.status === here?.status) return;
    fill(now, here?.status && status(here.status));
    if (here?.status) now.dataset.status = here.status;
    set(item.firstChild, "data-status", here?.status);
  });
}

function drawLog(passed) {
  if (log.childElementCount !== run.events.length) {
    fill(log, run.events.map(([t, mission, block, status_]) => h("li", {},
      h("button", { type: "button", class: "log-line", tabIndex: -1, onclick: () => { stop(); seek(t); } },
        h("span", { class: "when" }, minutes(t)), h("strong", {}, mission), `${block}`, status_ && status(status_)))));
  }
  log.querySelector("[aria-current]")?.removeAttribute("aria-current");
  const here = log.children[passed - 1];
  here?.setAttribute("aria-current", "true");
  if (here) log.scrollTop = here.offsetTop - log.clientHeight + here.offsetHeight + 8;
}

