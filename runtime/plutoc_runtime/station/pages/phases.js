// How things stand, in words: the phase of the flight, and what Start would do.

import { many } from "./words.js";

const FLYING = new Set(["flying", "stopping"]);

export const inTheAir = (state) => FLYING.has(state.phase);
export const toResume = (state) => state.phase === "stopped" || state.phase === "interrupted";

const DOWN = {
  rtl: "Stopping: the drones fly home",
  land: "Stopping: the drones land where they are",
};

// → [kind of chip, sign, words]
export function phaseWords(state) {
  switch (state.phase) {
    case "idle": return ["info", "info", "Ready"];
    case "flying": return ["good", "start", "Flying"];
    case "stopping": return ["warn", "wait", DOWN[state.how] ?? "Stopping: the drones come down"];
    case "stopped": return ["warn", "pause", "Stopped"];
    case "over": return ["info", "good", "All missions have ended"];
    case "interrupted": return ["warn", "warning", "Interrupted"];
    default: return ["", "wait", "Connecting"];
  }
}

// The first of what is to be mended, in one line.
function firstOf(problems, missions) {
  const { mission: key, trip: tripKey, text } = problems[0];
  const mission = missions.find((each) => each.key === key);
  const at = mission?.trips.findIndex((trip) => trip.key === tripKey) ?? -1;
  const trip = at < 0 ? "" : `, trip ${mission.trips[at].name ?? at + 1}`;
  const where = mission ? `${mission.name.trim() || "A mission"}${trip}` : "";
  const more = problems.length > 1 ? ` And ${problems.length - 1} more.` : "";
  const words = text.replace(/[.]?$/, ".");
  const all = !where ? words
    : words.startsWith("Has ") ? `${where} h${words.slice(1)}` : `${where}: ${words}`;
  return `${all}${more}`;
}

// What Start would do now: its words, whether it can, and what to say beside it.
export function startWords(state, plan) {
  const flying = state.phase === "flying";
  const todo = plan.missions.filter((mission) => !flying || !mission.launched);
  const keys = new Set(todo.map((mission) => mission.key));
  const bad = plan.problems.filter(({ mission }) => mission === null || keys.has(mission));
  const text = !todo.length || state.phase === "stopping" ? "Start"
    : `Start ${flying ? many(todo.length, "new mission") : many(todo.length, "mission")}`;
  const no = (why) => ({ text, able: false, why });
  if (!plan.loaded || state.phase === "unknown") return no("");
  if (state.busy) return no(state.busy);
  if (state.phase === "stopping") return no("");
  if (toResume(state)) {
    return no(state.phase === "stopped"
      ? "Resume goes on with every mission where it was. Put away begins afresh."
      : "A flight was broken off. Resume goes on with it; Put away begins afresh.");
  }
  if (!todo.length) {
    return no(flying ? "All missions are started. More can be added at any time."
      : "Nothing to start yet: add a mission first.");
  }
  if (bad.length) return no(firstOf(bad, todo));
  const why = { idle: "All is set.", over: "Start flies the whole plan again." }[state.phase] ?? "";
  return { text, able: true, why };
}
