// The usual changes of a plan, for `plan.edit`: functions from missions to missions that find what
// they change by key. Missions that have been launched stay as they are.

import { freeName, newKey } from "./words.js";

const names = (missions) => missions.map((mission) => mission.name);

// change: mission → mission
export function inMission(key, change) {
  return (missions) =>
    missions.map((mission) =>
      mission.key === key && !mission.launched ? change(mission) : mission);
}

// A field's value; undefined takes the field away.
export function withField(thing, name, value) {
  const { [name]: _, ...rest } = thing;
  return value === undefined ? rest : { ...thing, [name]: value };
}

export function setField(key, name, value) {
  return inMission(key, (mission) => withField(mission, name, value));
}

export function addMission(key, extra = {}) {
  return (missions) => {
    if (missions.some((mission) => mission.key === key)) return missions;
    const name = freeName("Mission", names(missions), missions.length + 1);
    return [...missions, { key, name, trips: [], launched: false, ...extra }];
  };
}

export function copyMission(key, fresh) {
  const keys = new Map(); // the same new keys each time that the change is made
  const another = (old) => keys.get(old) ?? keys.set(old, newKey()).get(old);
  return (missions) => {
    const at = missions.findIndex((mission) => mission.key === key);
    if (at < 0 || missions.some((mission) => mission.key === fresh)) return missions;
    const from = missions[at];
    const stem = from.name.trim().replace(/ \d+$/, "") || "Mission";
    const copy = {
      ...from, key: fresh, launched: false, name: freeName(stem, names(missions), 2),
      trips: from.trips.map((trip) => ({ ...trip, key: another(trip.key) })),
    };
    return missions.toSpliced(at + 1, 0, copy);
  };
}

export function deleteMission(key) {
  return (missions) => missions.filter((mission) => mission.key !== key || mission.launched);
}

// Puts back what was deleted.
export function putBack(mission, index) {
  return (missions) =>
    missions.some((other) => other.key === mission.key)
      ? missions
      : missions.toSpliced(index, 0, { ...mission, launched: false });
}

// Moves a thing with this key to a place of its list: missions, or the trips of one.
export function moved(list, key, to) {
  const from = list.findIndex((thing) => thing.key === key);
  if (from < 0) return list;
  const rest = list.toSpliced(from, 1);
  return rest.toSpliced(Math.max(0, Math.min(to, rest.length)), 0, list[from]);
}

export function moveMission(key, to) {
  return (missions) => moved(missions, key, to);
}
