// The station's page: messages, the head with Start and the two Stops, and the pages, which are
// loaded one by one: though one of them is broken, Stop works.

import {
  command, get, keepToken, liveFeed, planKept, selection, takeToken, token, wait,
} from "./api.js";
import { button, clock, fill, h, icon, many, put, set, shown } from "./dom.js";

const loudly = h("div", { role: "alert" });
const politely = h("div", { role: "status" });
const silently = h("div", { class: "unseen", role: "status" });
const notices = h("div", { class: "notices" }, loudly, politely, silently);

let timer = 0;

// Bad ones stay until they are put away, or something settles them; undo: a function.
function say(text, { undo = null, bad = false, settles = false } = {}) {
  if (settles) fill(loudly);
  const place = bad ? loudly : politely;
  const away = () => fill(place);
  const back = () => { away(); undo(); };
  fill(place, h("div", { class: bad ? "notice bad" : "notice" },
    icon(bad ? "bad" : "info"), h("p", {}, text),
    undo && button("Undo", back, "small"),
    h("button", { class: "button quiet icon", "aria-label": "Close this message", onclick: away },
      icon("close"))));
  if (bad) return;
  clearTimeout(timer);
  timer = setTimeout(away, undo ? 20000 : 6000);
}

// Only read out, not shown.
const hush = (text) => put(silently, text);

// A command, with what the station says to it → whether it was done.
async function tell(name, given = {}) {
  try {
    say(await command(name, given));
    return true;
  } catch (error) {
    say(error.message, { bad: true });
    return false;
  }
}

const URGENT = "If it is urgent, use the drones' own switches.";

// Tried for a minute.
async function stop(how) {
  const alarm = setTimeout(say, 1500,
    `Stop has not reached the station yet: trying again. ${URGENT}`, { bad: true });
  try {
    say(await command("stop", { how }, 60000));
    fill(loudly);
  } catch (error) {
    say(error.status ? error.message : `Stop did not reach the station. ${URGENT}`, { bad: true });
  }
  clearTimeout(alarm);
}

// Start, of the missions with these keys, or of what has not been completed; then to the Monitor,
// unless the page is left before the answer comes.
async function begun(missions = null) {
  const there = now;
  const wrong = plan.problems.find(({ mission }) => missions?.includes(mission));
  if (wrong) {
    lead(wrong);
    say(inFull(plan.missions, wrong), { bad: true });
  } else if (!await plan.saved()) {
    say("The plan is not saved yet, so it was not started.", { bad: true });
  } else if (await tell("start", { revision: plan.revision(), missions }) && now === there) {
    go("monitor");
  }
  plan.load().catch(() => null);
}

const DOWN = { rtl: "The drones fly home.", land: "The drones land where they are." };
const PHASES = { // kind of chip, sign, words
  idle: ["info", "info", "Ready"],
  flying: ["good", "start", "Flying"],
  stopping: ["warn", "wait", "Stopping"],
  stopped: ["warn", "pause", "Stopped"],
  over: ["info", "good", "All missions have ended"],
  interrupted: ["warn", "warning", "Interrupted"],
};

function inFull(missions, { mission: key, trip, text }) {
  const mission = missions.find((one) => one.key === key);
  const nth = mission && trip && mission.trips.findIndex((one) => one.key === trip) + 1;
  return `${mission?.name.trim() || "The plan"}${nth ? `, trip ${nth}` : ""}: ${text}`;
}

// → the button's words, whether it can be pressed, what to say beside it, the problem
// if it is one, whether something was completed and something was not
function startWords({ phase, busy, how, said: trouble }, plan, drones) {
  const flying = phase === "flying";
  const open = plan.missions.filter(({ launched, ended }) => !launched && ended !== "COMPLETED");
  const todo = open.length || flying ? open : plan.missions;
  const bad = plan.problems.filter(({ mission: key }) =>
    key === null || todo.some((mission) => mission.key === key));
  const text = !todo.length || phase === "stopping" ? "Start"
    : `Start ${many(todo.length, flying ? "new mission" : "mission")}`;
  const lost = [...drones.values()].filter(({ status }) => status === "LOST");
  const other = busy
    || (phase === "stopping" && DOWN[how])
    || (phase === "stopped" && "Resume goes on with every mission where it was.")
    || (phase === "interrupted" && (trouble || "A flight was broken off. Resume goes on with it."))
    || (!todo.length && (flying ? "All missions are started. More can be added at any time."
      : "Nothing to start yet: add a mission first."))
    || (!flying && lost.length && lost.length === drones.size
      && "Every drone is lost: look after one, and bring it back first.");
  const problem = (!other && bad[0]) || null;
  const why = other || (problem && inFull(todo, problem)
    + (bad.length > 1 ? ` (and ${bad.length - 1} more)` : ""));
  const some = open.length > 0 && open.length < plan.missions.length && !flying;
  const hint = [
    some && (open.some(({ ended }) => ended)
      ? "Start flies what was not completed, each mission from its beginning."
      : "Start leaves out what was completed."),
    !open.length && !flying && "All are completed: Start flies them all again.",
    !flying && lost.length > 0 && `Lost, and left out until brought back: ${
      lost.map(({ id }) => id).join(", ")}.`,
  ].filter(Boolean).join(" ");
  const can = !why && plan.loaded && phase in PHASES;
  return [text, can, why || hint, problem, some];
}

function head({ live, plan, go, lead, app }, bar) {
  const title = h("h1", {}, "Ground station");
  const phase = h("span", { class: "chip" });
  const time = h("span", { class: "num" });
  const simulated = h("span", { class: "chip", hidden: true });
  const reason = h("span", { class: "muted" });
  const fix = h("button", { class: "link", onclick: () => lead(problem) });
  const why = h("span", { class: "why", id: "why" }, reason, fix);
  let problem = null;
  const unsaved = h("span", { class: "chip warn" }, "Not saved yet");
  const age = h("span", { class: "chip num age" });
  const lostAge = h("span", { "aria-live": "off" });
  const lost = h("div", { class: "lost", role: "alert" });
  const lostText = [icon("warning"), h("p", {}, h("strong", {}, "Connection lost: "), lostAge,
    "trying again. Both Stop buttons keep trying to reach the station.")];
  let able = false;
  let last = "";

  const start = button("Start", () => {
    if (able) begun();
    else if (why.textContent) say(why.textContent);
  }, "primary", "start");
  const all = button("", () => begun(plan.missions.map(({ key }) => key)), "small");
  const resume = button("Resume", async () => {
    const there = now;
    if (await tell("resume") && now === there) go("monitor");
  }, "primary", "start");
  const away = button("Put away", () => tell("discard"));
  const home = button("Stop: fly home", () => stop("rtl"), "danger", "home");
  const land = button("Stop: land now", () => stop("land"), "danger", "land");
  set(start, "aria-describedby", "why");

  function update() {
    const { state } = live;
    const [kind, sign, words] = PHASES[state.phase] ?? ["", "wait", "Connecting"];
    const known = state.phase in PHASES;
    const flies = state.phase === "flying" || state.phase === "stopping";
    const waits = state.phase === "stopped" || state.phase === "interrupted";
    const [text, can, because, bad, some] = startWords(state, plan, live.drones);
    problem = bad;
    able = can && !live.lost();
    put(start.lastChild, text);
    set(start, "aria-disabled", able ? null : "true");
    put(all.lastChild, `Start all ${plan.missions.length} again`);
    shown(all, some && able);
    shown(start, !waits);
    shown(resume, waits);
    shown(away, waits);
    home.disabled = land.disabled = known && !flies && !live.lost();
    for (const [one, yes] of [[reason, !bad], [fix, bad]]) {
      put(one, yes && known && plan.loaded ? because : "");
      shown(one, one.textContent);
    }

    if (last !== words) {
      if (last && known) hush(words);
      last = words;
      set(phase, "class", `chip big ${kind}`);
      fill(phase, icon(sign), words);
    }
    put(time, flies || state.time > 0 ? clock(state.time) : "");
    if (app.title) {
      put(title, app.title);
      put(simulated, app.speed === 1 ? "simulated" : `simulated × ${app.speed}`);
      shown(simulated, app.sim);
      const name = `${flies ? `${words} · ` : ""}${app.title}`;
      if (document.title !== name) document.title = name;
    }
    shown(unsaved, plan.trouble);

    const old = live.age();
    const gone = known && live.lost();
    const since = `${Math.round(old / 1000)} s old`;
    put(age, old < 1500 ? "live" : known ? since : "not connected");
    set(age, "class", `chip num age ${gone ? "bad" : old < 1500 ? "good" : "warn"}`);
    if (gone) put(lostAge, `what you see is ${since}; `);
    if (gone !== lost.hasChildNodes()) fill(lost, gone && lostText);
  }
  setInterval(update, 500);
  const element = h("header", { class: "top" },
    h("div", { class: "head" }, title, bar,
      h("div", { class: "run", role: "group", "aria-label": "Fly" },
        start, resume, away, home, land)),
    h("div", { class: "row strip" }, phase, time, simulated, why, all,
      h("span", { class: "row spread" }, unsaved, age)),
    lost);
  update();
  return { element, update };
}

const IDS = ["missions", "trips", "monitor", "help"];

takeToken();
const live = liveFeed();
const plan = planKept();
const context = {
  app: {}, live, plan, say, hush, tell, begun, selected: selection(plan), go, lead,
};
const pages = new Map();
let now = "";
let said = "";

// A tab and its page for each; which one is open stands in the address after #.
const buttons = IDS.map((id) => h("button", {
  class: "tab", role: "tab", id: `tab-${id}`, "aria-controls": `page-${id}`, onclick: () => go(id),
}, id[0].toUpperCase() + id.slice(1)));
const panels = IDS.map((id) => h("section", {
  class: "page", role: "tabpanel", id: `page-${id}`, "aria-labelledby": `tab-${id}`,
}));
const bar = h("div", {
  class: "tabs", role: "tablist", "aria-label": "Pages",
  onkeydown(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const to = (IDS.indexOf(now) + step + IDS.length) % IDS.length;
    go(IDS[to]);
    buttons[to].focus();
  },
}, buttons);

function go(id, quiet) {
  const there = pages.get(now);
  now = IDS.includes(id) ? id : IDS[0];
  if (!quiet && location.hash !== `#${now}`) history.pushState(null, "", `#${now}`);
  IDS.forEach((other, i) => {
    set(buttons[i], "aria-selected", String(other === now));
    buttons[i].tabIndex = other === now ? 0 : -1;
    shown(panels[i], other === now);
  });
  there?.hide?.();
  pages.get(now)?.show?.();
}

// To the field where something is wrong.
function lead({ mission, trip, field }) {
  context.selected.set(mission);
  go(trip || (mission && !field) ? "trips" : "missions");
  pages.get(now)?.lead?.({ trip, field });
}

const top = head(context, bar);

async function make(id, i) {
  try {
    const module = await import(id === "monitor" ? "./monitor.js" : "./missions.js");
    const page = module[id](context);
    pages.set(id, page);
    panels[i].append(page.element);
    if (now === id) page.show?.();
  } catch (error) {
    console.error(error);
    fill(panels[i], h("p", { class: "card" },
      "This page could not be shown. Load it again; Stop works here, too."));
  }
}

// Without the station's token: where to find it, and a place to put it. Any other no is shown.
function closed({ status, message }) {
  const input = h("input", { id: "token", type: "password", autocomplete: "off", required: true });
  const form = h("form", {
    class: "stack",
    onsubmit(event) {
      event.preventDefault();
      keepToken(input.value.replace(/^.*#token=/, ""));
      location.reload();
    },
  },
  h("p", {}, "It stands in the address that the station printed when it began: open that, or ",
    "paste it here."),
  h("div", { class: "field" }, h("label", { for: "token" }, "Address or token"), input),
  token() && h("p", { class: "problem", role: "alert" }, icon("warning"),
    "The station knows no such token."),
  h("div", {}, button("Open the station", null, "primary")));
  fill(document.body, h("main", { class: "gate" }, h("div", { class: "card stack" },
    h("h1", {}, status === 401 ? "This station asks for its token" : message),
    status === 401 && form)));
}

// → whether we may know what app this is
async function described() {
  for (;;) {
    try {
      Object.assign(context.app, await get("/api/app"));
      return true;
    } catch (error) {
      if (error.status === 401 || error.status === 403) {
        closed(error);
        return false;
      }
    }
    await wait(1000);
  }
}

let loading = false;
async function loadPlan() {
  if (loading) return;
  loading = true;
  await plan.load().catch(() => wait(500)); // asked again as long as the revisions differ
  loading = false;
}

// The station was started again: its app may be another by now.
async function anew() {
  const shape = () => JSON.stringify({ ...context.app, server: "", sim: "", speed: "" });
  const was = shape();
  if (!await described()) return;
  if (shape() !== was) location.reload();
  hush("The station was started again.");
  loadPlan();
}

async function begin() {
  fill(document.body, top.element, h("main", {}, panels), notices);
  go(location.hash.slice(1), true);
  window.addEventListener("popstate", () => go(location.hash.slice(1), true));
  if (!await described()) return;
  live.changed.heard((changes) => {
    top.update();
    if (live.state.plan !== plan.revision() && !plan.unsaved()) loadPlan();
    pages.get(now)?.update?.(live, changes);
  });
  live.other.heard(anew);
  live.denied.heard(() => closed({ status: 401 }));
  plan.changed.heard(() => {
    top.update();
    if (plan.said && plan.said !== said) say(plan.said, { bad: true });
    said = plan.said;
  });
  plan.refused.heard((text) => say(text, { bad: true }));
  window.addEventListener("beforeunload", (event) => plan.trouble && event.preventDefault());
  live.start();
  loadPlan();
  IDS.forEach(make);
}

begin();
