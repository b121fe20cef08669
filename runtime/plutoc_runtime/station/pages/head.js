// The head of every page: the app's name, the tabs, Start, Resume and Put away, the two Stops, how
// things stand and how old that is; and the messages at the lower edge.

import { command } from "./api.js";
import { clock, fill, h, icon, many, put, set, shown } from "./dom.js";

const loudly = h("div", { role: "alert" });
const politely = h("div", { role: "status" });
const silently = h("div", { class: "unseen", role: "status" });
export const notices = h("div", { class: "notices" }, loudly, politely, silently);

let timer = 0;

// Bad ones stay until they are put away; undo: a function.
export function say(text, { undo = null, bad = false } = {}) {
  const place = bad ? loudly : politely;
  const away = () => fill(place);
  const back = () => { away(); undo(); };
  fill(place, h("div", { class: bad ? "notice bad" : "notice" },
    icon(bad ? "bad" : "info"), h("p", {}, text),
    undo && h("button", { class: "button small", onclick: back }, "Undo"),
    h("button", { class: "button quiet icon", "aria-label": "Close this message", onclick: away },
      icon("close"))));
  if (bad) return;
  clearTimeout(timer);
  timer = setTimeout(away, undo ? 20000 : 6000);
}

// Only read out, not shown.
export const hush = (text) => put(silently, text);

// A command, with what the station says to it → whether it was done.
export async function tell(name, given = {}) {
  try {
    say(await command(name, given));
    return true;
  } catch (error) {
    say(error.message, { bad: true });
    return false;
  }
}

const URGENT = "If it is urgent, use the drones' own switches.";

// Tried for a minute, whatever happens.
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

const DOWN = { rtl: "the drones fly home", land: "the drones land where they are" };
const PHASES = { // kind of chip, sign, words
  idle: ["info", "info", "Ready"],
  flying: ["good", "start", "Flying"],
  stopping: ["warn", "warning", "Stopping"],
  stopped: ["warn", "warning", "Stopped"],
  over: ["info", "info", "All missions have ended"],
  interrupted: ["warn", "warning", "Interrupted"],
};

// The first of what is to be mended, in one line.
function firstOf(problems, missions) {
  const { mission: key, trip: tripKey, text } = problems[0];
  const mission = missions.find((one) => one.key === key);
  const at = mission?.trips.findIndex((trip) => trip.key === tripKey) ?? -1;
  const where = mission?.name + (at < 0 ? "" : `, trip ${mission.trips[at].name ?? at + 1}`);
  const words = text.startsWith("Has ") ? ` h${text.slice(1)}` : `: ${text}`;
  return (mission ? where + words : text)
    + (problems.length > 1 ? ` – and ${problems.length - 1} more` : "");
}

// → [the button's words, whether it can be pressed, what to say beside it]
function startWords({ phase, busy, how }, plan) {
  const flying = phase === "flying";
  const todo = plan.missions.filter((mission) => !flying || !mission.launched);
  const bad = plan.problems.filter(({ mission: key }) =>
    key === null || todo.some((mission) => mission.key === key));
  const text = !todo.length || phase === "stopping" ? "Start"
    : `Start ${many(todo.length, flying ? "new mission" : "mission")}`;
  const why = busy
    || (phase === "stopping" && `${DOWN[how] ?? ""}`)
    || (phase === "stopped" && "Resume goes on with every mission where it was.")
    || (phase === "interrupted" && "A flight was broken off. Resume goes on with it.")
    || (!todo.length && (flying ? "All missions are started. More can be added at any time."
      : "Nothing to start yet: add a mission first."))
    || (bad.length > 0 && firstOf(bad, todo));
  if (why) return [text, false, why];
  return [text, plan.loaded && phase in PHASES, phase === "over" ? "Start flies it all again." : ""];
}

export function head({ live, plan, go, app }, bar) {
  const title = h("h1", {}, "Ground station");
  const phase = h("span", { class: "chip" });
  const time = h("span", { class: "num" });
  const simulated = h("span", { class: "chip", hidden: true });
  const why = h("span", { class: "muted", id: "why" });
  const unsaved = h("span", { class: "chip warn" }, "Not saved yet");
  const age = h("span", { class: "chip num age" });
  const lostAge = h("span", { "aria-live": "off" });
  const lost = h("div", { class: "lost", role: "alert" });
  const lostText = [icon("warning"), h("p", {}, h("strong", {}, "Connection lost: "), lostAge,
    "trying again. Both Stop buttons keep trying to reach the station.")];
  let able = false;
  let last = "";

  const button = (kind, sign, text, onclick) =>
    h("button", { class: `button ${kind}`, onclick }, icon(sign), h("span", {}, text));
  const start = button("primary", "start", "Start", async () => {
    if (!able) {
      if (why.textContent) say(why.textContent);
      return;
    }
    if (!await plan.saved()) {
      say("The plan is not saved yet, so it was not started.", { bad: true });
    } else if (await tell("start", { revision: plan.revision() })) go("monitor");
    plan.load().catch(() => null);
  });
  const resume = button("primary", "start", "Resume",
    async () => await tell("resume") && go("monitor"));
  const away = button("", "close", "Put away", () => tell("discard"));
  const home = button("danger", "home", "Stop: fly home", () => stop("rtl"));
  const land = button("danger", "land", "Stop: land now", () => stop("land"));
  set(start, "aria-describedby", "why");

  function update() {
    const { state } = live;
    const [kind, sign, words] = PHASES[state.phase] ?? ["", "info", "Connecting"];
    const known = state.phase in PHASES;
    const flies = state.phase === "flying" || state.phase === "stopping";
    const waits = state.phase === "stopped" || state.phase === "interrupted";
    const [text, can, reason] = startWords(state, plan);
    able = can && !live.lost();
    put(start.lastChild, text);
    set(start, "aria-disabled", able ? null : "true");
    shown(start, !waits);
    shown(resume, waits);
    shown(away, waits);
    home.disabled = land.disabled = known && !flies && !live.lost();
    put(why, known && plan.loaded ? reason : "");

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
    h("div", { class: "row strip" }, phase, time, simulated, why,
      h("span", { class: "row spread" }, unsaved, age)),
    lost);
  return { element, update };
}
