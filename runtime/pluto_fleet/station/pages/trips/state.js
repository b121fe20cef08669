// What is going on at the map of the trips: which pins are selected, what is held, which tool is at work.

import { computed, signal } from "@preact/signals";
import { t } from "../core/i18n.js";
import { landmarks } from "../core/landmarks.js";
import { marking } from "../core/marking.js";
import { app, mayFly, plan, selected, selection, selectKey, world } from "../core/station.js";
import { whyNot } from "../map/view.js";
import { picks } from "./carried.js";
import { placeAt } from "./snapping.js";

/** Where pins are that are being dragged, by the keys of their trips. @type {Signal<ReadonlyMap<string, Point>>} */
export const held = signal(new Map());

/** The action that is in hand, to be put down by the next press on the map. @type {Signal<ActionShape | null>} */
export const inHand = signal(null);

/** Where the action in hand, or the one that is dragged, would be put now. @type {Signal<[number, number] | null>} */
export const hovered = signal(null);

/** @typedef {"area" | "row" | "grid" | "sweep"} Tool what a drag over the ground does, in place of moving the map */
/** @type {Signal<Tool | null>} */
export const tool = signal(null);

/** The rectangle or the line that was drawn last, in metres. @type {Signal<{ from: At, to: At } | null>} */
export const drawn = signal(null);

/** What the tool at work would add. @type {Signal<readonly (Pick<SweptTrip, "target"> & Partial<SweptTrip>)[]>} */
export const pattern = signal([]);

export const { marked, markOne, markAll, toggle, extendTo } = marking(
  () => selected.value?.trips.map(({ key }) => key) ?? [], () => selection.value.trip,
  (key) => selectKey(selection.peek().key, key));

export const places = computed(() => landmarks.value?.places ?? []);

/** The selected mission in the flight, if it is under way. */
const row = computed(() => (selected.value?.launched ? world.missions.get(selected.value.name) : undefined));

/** Whether nothing at all can be changed of the selected mission's trips. */
export const isLocked = computed(() => {
  const mission = selected.value;
  if (!mission || !mayFly.value) return true;
  return mission.launched && (world.state.value.phase !== "flying" || row.value === undefined);
});

/** The names of the trips that fly or have flown, a line each, so that it is the same until one takes off. */
const offLines = computed(() => (row.value?.trips ?? []).filter(({ status }, at) =>
  status !== "WAITING" || (at === row.value?.current && row.value.status === "RUNNING")).map(({ name }) => name).join("\n"));
const offNames = computed(() => new Set(offLines.value ? offLines.value.split("\n") : []));

/** The trips of the selected mission. */
export const abouts = computed(() => {
  const mission = selected.value;
  if (!mission) return [];
  const from = picks(mission.trips);
  /** @type {Map<string | null, ShownProblem[]>} */
  const wrong = new Map();
  for (const one of plan.problems.value) {
    if (one.mission === mission.key) wrong.set(one.trip, [...(wrong.get(one.trip) ?? []), one]);
  }
  /** @type {Map<string, number>} */
  const taken = new Map();
  return mission.trips.map((trip, at) => {
    const one = about(trip, at, wrong.get(trip.key) ?? [], from.get(trip.key));
    const where = one.target?.slice(0, 2).map((value) => value.toFixed(1)).join(" ") ?? "";
    const beside = taken.get(where) ?? 0;
    taken.set(where, beside + 1);
    return { ...one, beside };
  });
});

/** @param {PlanTrip} trip @param {number} at @param {ShownProblem[]} wrong @param {number | undefined} pick @returns {Omit<About, "beside">} */
function about(trip, at, wrong, pick) {
  const drag = held.value.get(trip.key);
  const target = drag && trip.target ? [...drag, ...trip.target.slice(2)] : trip.target;
  const problems = wrong.filter(({ field }) => !(drag && field === "target")
    && !(pick !== undefined && field?.startsWith("item."))); // the trip that picks it tells that
  const here = drag && app.value ? whyNot(app.value.map, drag) : "";
  if (here) problems.unshift({ mission: null, trip: trip.key, field: "target", text: t(here), isOwn: true });
  return {
    key: trip.key, trip, number: at + 1, target, isHeld: drag !== undefined,
    place: target ? placeAt(target, places.value)?.name ?? "" : "",
    isFixed: isLocked.value || offNames.value.has(trip.name ?? String(at + 1)),
    problems, pickedIn: pick === undefined ? null : pick + 1,
  };
}
