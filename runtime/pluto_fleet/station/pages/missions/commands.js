// What is done with missions on their page: selected, added, copied, deleted, moved, started; and plans that come
// from elsewhere, the example or a file, and the plan as a file.

import { signal } from "@preact/signals";
import { send, StationError } from "../core/api.js";
import { DRAWN, typeOf } from "../core/drawings.js";
import { addMission, copyMission, moved, newKey, removeMission } from "../core/changes.js";
import { many, t } from "../core/i18n.js";
import { marking } from "../core/marking.js";
import { go } from "../core/route.js";
import { app, plan, save, selection, selectKey, speakOut, tellError, undo } from "../core/station.js";
import { drawTelling, tellUndoable } from "../ui/undo.js";
import { called } from "./words.js";

/** Whether a press on a mission adds it to those that are selected, for fingers. */
export const isMarking = signal(false);

export const { marked, markOne, markAll, toggle, extendTo } = marking(
  () => plan.missions.value.map(({ key }) => key), () => selection.value.key, (key) => selectKey(key));

/** @param {string} key */
const at = (key) => plan.missions.peek().findIndex((mission) => mission.key === key);

/** Add a mission and select it; returns its key. */
export function add() {
  const key = newKey();
  plan.edit(addMission(key, t("mission")));
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

/** Let the station put another plan in place of this one. @param {(revision: number) => Promise<{ status: number, data: any }>} ask @param {string} said */
export async function take(ask, said) {
  await plan.saved();
  const before = plan.missions.peek();
  try {
    const { status, data } = await ask(plan.revision);
    if (!data.missions) throw new StationError(data.said, status);
    plan.take(data);
    if (status === 409) throw new StationError(t("missions.changed-meanwhile"), status, false);
  } catch (error) {
    tellError(error);
    return;
  }
  undo.record(before, plan.missions.peek());
  markOne(plan.missions.peek().find(({ launched }) => !launched)?.key ?? null);
  tellUndoable(before, said);
}

export const example = () => take(
  (revision) => send("POST", "/api/plan/example", { revision }), t("missions.example-here"));

/** Ask for a file, and read it into the plan. */
export function importFile() {
  const input = document.createElement("input");
  Object.assign(input, { type: "file", accept: [".toml", ...DRAWN].join() });
  input.addEventListener("change", async () => {
    const file = input.files?.[0];
    if (!file) return;
    take((revision) => send("POST", `/api/plan/import?revision=${revision}&file=${encodeURIComponent(file.name)}`,
      file, { type: typeOf(file.name) }), t("missions.imported", { file: file.name }));
  });
  input.click();
}

export async function exportFile() {
  await plan.saved();
  save("/api/plan.toml", `${app.peek()?.name}-missions.toml`);
}
