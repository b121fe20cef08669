// The head of every page: the app's name, the tabs, the buttons that fly, and under them how things
// stand and how old that is.

import { fill, h, put, set, shown } from "./dom.js";
import { icon } from "./icons.js";
import { inTheAir, phaseWords } from "./phases.js";
import { runButtons } from "./run_buttons.js";
import { hush } from "./say.js";
import { clock } from "./words.js";

function ageChip(live) {
  const words = h("span", {}, "…");
  const node = h("span", { class: "chip age num" }, h("span", { class: "dot" }), words);
  return {
    node,
    update() {
      const age = live.age();
      const old = age >= 1500;
      const seconds = `${Math.round(age / 1000)} s old`;
      put(words, !Number.isFinite(age) ? "not connected" : old ? seconds : "live");
      set(node, "class", `chip age num ${live.lost() ? "bad" : old ? "warn" : "good"}`);
    },
  };
}

// Said once, loudly; the seconds in it are counted quietly.
function lostBanner(live) {
  const age = h("span", { "aria-live": "off" });
  const text = h("p", {}, h("strong", {}, "Connection lost: "), age,
    "trying again. Both Stop buttons keep trying to reach the station.");
  const node = h("div", { class: "lost", role: "alert" });
  return {
    node,
    update() {
      const lost = live.lost() && live.state.phase !== "unknown";
      if (lost) put(age, `what you see is ${Math.round(live.age() / 1000)} s old; `);
      if (lost !== node.hasChildNodes()) fill(node, lost && icon("warning"), lost && text);
    },
  };
}

export function top(context, bar) {
  const { live, plan } = context;
  const title = h("h1", {}, "Ground station");
  const phase = h("span", { class: "chip" });
  const time = h("span", { class: "num", "aria-label": "Flight time" });
  const simulated = h("span", { class: "chip", hidden: true });
  const why = h("span", { class: "why", id: "start-why" });
  const unsaved = h("span", { class: "chip warn", hidden: true }, "Not saved yet");
  const age = ageChip(live);
  const lost = lostBanner(live);
  const run = runButtons(context, () => why.textContent);
  let last = "";

  const element = h("header", { class: "top" },
    h("div", { class: "head" }, title, bar, run.element),
    h("div", { class: "strip" }, phase, time, simulated, why,
      h("span", { class: "spread row" }, unsaved, age.node)),
    lost.node);

  function update() {
    const { state } = live;
    const [kind, sign, words] = phaseWords(state);
    const reason = run.update();
    if (last !== kind + words) {
      if (last && state.phase !== "unknown") hush(words);
      last = kind + words;
      set(phase, "class", `chip big ${kind}`);
      fill(phase, icon(sign), words);
    }
    put(time, inTheAir(state) || state.time > 0 ? clock(state.time) : "");
    const { app } = context;
    shown(simulated, app?.sim);
    if (app?.sim) put(simulated, app.speed === 1 ? "simulated" : `simulated × ${app.speed}`);
    put(why, reason);
    shown(unsaved, plan.unsaved() && plan.trouble);
    if (app) {
      put(title, app.title);
      const name = `${inTheAir(state) ? `${words} · ` : ""}${app.title}`;
      if (document.title !== name) document.title = name;
    }
    age.update();
    lost.update();
  }
  setInterval(update, 500);
  return { element, update };
}
