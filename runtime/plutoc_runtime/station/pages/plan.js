// The plan that everybody draws together, and its usual changes: functions from missions to
// missions (never changed in place) that find what they change by key. One is seen at once and
// saved by itself; where somebody was quicker, on top of theirs; without a connection, later.

import { get, send, wait } from "./api.js";
import { bell, freeName, newKey } from "./dom.js";

const TYPING = 300; // ms
const BETWEEN = 120; // two savings, also while a pin is dragged

export function planKept() {
  let base = { revision: 0, missions: [], problems: [] };
  let pending = []; // changes that the station does not know yet
  let timer = 0;
  let sending = false;
  let tries = 0;
  let sentAt = -BETWEEN;
  // said: what is wrong with keeping it at the station; trouble: why it is not saved
  const plan = {
    missions: [], problems: [], said: "", trouble: "", loaded: false,
    changed: bell(), refused: bell(),
  };

  function replay() {
    plan.missions = pending.reduce((missions, change) => change(missions), base.missions);
    plan.problems = base.problems;
    plan.said = base.said ?? "";
    plan.changed.ring();
  }

  function later(time) {
    clearTimeout(timer);
    timer = setTimeout(save, Math.max(time, sentAt + BETWEEN - performance.now()));
  }

  async function save() {
    clearTimeout(timer);
    if (sending || !pending.length || !plan.loaded) return;
    sending = true;
    sentAt = performance.now();
    const sent = pending.length;
    try {
      const content = { revision: base.revision, missions: plan.missions };
      const { status, data } = await send("PUT", "/api/plan", content);
      if (status !== 409) pending = pending.slice(sent);
      plan.take(data);
    } catch ({ status, message }) {
      if (status === 400 || status === 413) { // the station will never have it
        pending = pending.slice(sent);
        replay();
        plan.refused.ring(message);
      } else {
        tries = Math.min(tries + 1, 3);
        plan.trouble = message;
        plan.changed.ring();
      }
    }
    sending = false;
    if (pending.length) later(tries ? Math.min(2000, 250 * 2 ** tries) : 0);
  }

  plan.take = (fresh) => {
    base = fresh;
    plan.loaded = true;
    plan.trouble = "";
    tries = 0;
    replay();
  };
  plan.load = async () => {
    const fresh = await get("/api/plan");
    if (!sending && (!plan.loaded || fresh.revision !== base.revision)) plan.take(fresh);
    if (pending.length) later(0);
  };
  plan.revision = () => base.revision;
  plan.unsaved = () => pending.length > 0;
  // Resolves when everything is saved, or after a while.
  plan.saved = async () => {
    if (pending.length) later(0);
    for (let i = 0; pending.length && i < 100; i += 1) await wait(30);
    return !pending.length;
  };
  plan.edit = (change, typing = false) => {
    pending.push(change);
    plan.missions = change(plan.missions);
    plan.changed.ring();
    later(typing ? TYPING : 0);
  };
  return plan;
}

// Which mission is selected, on all pages alike; a tab that is loaded again remembers it.
export function selection(plan) {
  const NAME = "pluto-selected";
  const selected = { key: sessionStorage.getItem(NAME), changed: bell() };
  selected.mission = () => plan.missions.find(({ key }) => key === selected.key) ?? null;
  selected.set = (key) => {
    if (key === selected.key) return;
    selected.key = key;
    if (key === null) sessionStorage.removeItem(NAME);
    else sessionStorage.setItem(NAME, key);
    selected.changed.ring();
  };
  plan.changed.heard(() => plan.loaded && !selected.mission() && selected.set(null));
  return selected;
}

const names = (missions) => missions.map(({ name }) => name);
const has = (missions, key) => missions.some((mission) => mission.key === key);

// change: mission → mission. Those that fly stay as they are.
export const inMission = (key, change) => (missions) =>
  missions.map((mission) =>
    mission.key === key && !mission.launched ? change(mission) : mission);

// undefined takes the field away
export function withField(thing, name, value) {
  const { [name]: _, ...rest } = thing;
  return value === undefined ? rest : { ...thing, [name]: value };
}

export const setField = (key, name, value) =>
  inMission(key, (mission) => withField(mission, name, value));

export const addMission = (key, extra = {}) => (missions) => has(missions, key) ? missions : [
  ...missions,
  { key, name: freeName("Mission", names(missions), missions.length + 1), trips: [], ...extra },
];

export function copyMission(key, fresh) {
  const keys = new Map(); // the same new keys each time that the change is made
  const another = (old) => keys.get(old) ?? keys.set(old, newKey()).get(old);
  return (missions) => {
    const at = missions.findIndex((mission) => mission.key === key);
    if (at < 0 || has(missions, fresh)) return missions;
    const { launched, name, trips, ...rest } = missions[at];
    return missions.toSpliced(at + 1, 0, {
      ...rest, key: fresh, name: freeName(name.trim().replace(/ \d+$/, ""), names(missions), 2),
      trips: trips.map((trip) => ({ ...trip, key: another(trip.key) })),
    });
  };
}

export const deleteMission = (key) => (missions) =>
  missions.filter((mission) => mission.key !== key || mission.launched);

export const putBack = (mission, index) => (missions) =>
  has(missions, mission.key) ? missions : missions.toSpliced(index, 0, mission);

// A list of missions or trips, with one of them at another place.
export function moved(list, key, to) {
  const from = list.findIndex((thing) => thing.key === key);
  if (from < 0) return list;
  const rest = list.toSpliced(from, 1);
  return rest.toSpliced(Math.max(0, Math.min(to, rest.length)), 0, list[from]);
}
