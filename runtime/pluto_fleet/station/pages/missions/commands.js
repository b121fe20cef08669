// What is done with missions on their page: added, copied, deleted, moved, started.

import { addMission, copyMission, moved, removeMission } from "../core/changes.js";
import { drawTelling } from "../core/drawing.js";
import { many } from "../core/format.js";
import { t } from "../core/i18n.js";
import { newKey } from "../core/keys.js";
import { speakOut } from "../core/notices.js";
import { go } from "../core/route.js";
import { plan, selectKey } from "../core/station.js";
import { markAll, marked, markOne } from "./marked.js";
import { called } from "./words.js";

/** @param {string} key */
const at = (key) => plan.missions.peek().findIndex((mission) => mission.key === key);

/** Add a mission and select it; returns its key. */
export function add() {
  const key = newKey();
  plan.edit(addMission(key, t("missions.stem")));
  markOne(key);
  return key;
}

/** @param {readonly string[]} keys */
export function copy(keys) {
  const fresh = keys.map(() => newKey());
  const changes = keys.map((key, n) => copyMission(key, fresh[n]));
  plan.edit((missions) => changes.reduce((all, change) => change(all), missions));
  markAll(fresh);
}

/** Those of them that may be changed. @param {readonly string[]} keys */
export const unlocked = (keys) => keys.filter((key) => plan.missions.peek()[at(key)]?.launched === false);

/** @param {readonly string[]} chosen */
export function remove(chosen) {
  const keys = unlocked(chosen);
  if (!keys.length) return;
  const [first] = keys;
  const index = at(first);
  const name = called(plan.missions.peek()[index]);
  const said = keys.length === 1 ? t("missions.deleted", { mission: name }) : t("missions.deleted-many", { n: keys.length });
  drawTelling((missions) => keys.reduce((all, key) => removeMission(key)(all), missions), said);
  const left = plan.missions.peek();
  markOne((left[index] ?? left.at(-1))?.key ?? null);
}

/** @param {string} key @param {number} to */
export function move(key, to) {
  const mission = plan.missions.peek()[at(key)];
  if (!mission || to < 0 || to >= plan.missions.peek().length) return;
  plan.edit((missions) => moved(missions, key, to));
  speakOut(t("missions.moved", { mission: called(mission), n: to + 1 }));
}

/** Move by one place. @param {string} key @param {number} by */
export const shift = (key, by) => move(key, at(key) + by);

/** Go to a mission's trips. @param {string} key */
export function open(key) {
  selectKey(key);
  go("trips");
}

/** "3 missions, 7 trips are selected". */
export function selectedInWords() {
  const keys = marked.value;
  const missions = plan.missions.value.filter(({ key }) => keys.includes(key));
  return t("missions.selected", {
    missions: many("many.missions", missions.length),
    trips: many("many.trips", missions.reduce((sum, { trips }) => sum + trips.length, 0)),
  });
}
