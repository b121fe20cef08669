// What is done with trips: added, moved, copied, deleted, written into.

import { inTrips, moved, newKey, withField } from "../core/changes.js";
import { capital, number, place as inWords, t } from "../core/i18n.js";
import { plan, selection, speakOut } from "../core/station.js";
import { drawTelling } from "../ui/undo.js";
import { linked, PICK } from "./carried.js";
import { rounded } from "./snapping.js";
import { abouts, isLocked, markAll, marked, markOne } from "./state.js";

/** @returns {PlanTrip[]} */
const trips = () => plan.missions.peek().find(({ key }) => key === selection.peek().key)?.trips ?? [];
/** @param {string} key */
const at = (key) => trips().findIndex((trip) => trip.key === key);

/** Those of them that can be changed. @param {Iterable<string>} keys */
function free(keys) {
  const all = new Set(keys);
  return abouts.peek().filter(({ key, isFixed }) => all.has(key) && !isFixed).map(({ key }) => key);
}

/** What the selected mission's trips become; it finds what it changes by key, as others may have drawn meanwhile. @param {(all: PlanTrip[]) => PlanTrip[]} change */
const inSelected = (change) => inTrips(selection.peek().key ?? "", (all) => linked(change(all)));

/** @param {(all: PlanTrip[]) => PlanTrip[]} change @param {boolean} [typing] */
const edit = (change, typing = false) => plan.edit(inSelected(change), typing);

/** @param {readonly PlanTrip[]} fresh @param {number} index */
const put = (fresh, index) => edit((all) =>
  all.toSpliced(index, 0, ...fresh.filter(({ key }) => !all.some((one) => one.key === key))));

/** What is done on the way along a line, if it is one. @param {string} action @param {Partial<SweptTrip>} line */
const onTheWay = (action, { source, every }) =>
  (source && every ? { source: [...source], along: { action, every: `${every} m` } } : {});

/** Put an action at places, or along lines, as new trips. @param {ActionShape} action @param {readonly (Pick<SweptTrip, "target"> & Partial<SweptTrip>)[]} spots */
export function add(action, spots) {
  if (isLocked.peek() || !spots.length) return [];
  const before = trips();
  let items = before.filter((trip) => trip.action === PICK).length;
  const fresh = spots.map(({ target, ...line }) => {
    // how heavy an item is, only people know
    const item = action.item ? { name: items ? t("trips.item-n", { n: items + 1 }) : t("trips.item-stem") } : null;
    items += 1;
    return { key: newKey(), action: action.name, target: [...target], ...onTheWay(action.name, line), parameters: {}, item };
  });
  put(fresh, before.length);
  markOne(/** @type {PlanTrip} */ (fresh.at(-1)).key);
  speakOut(t("trips.added", { n: fresh.length, action: capital(action.name) }));
  return fresh.map(({ key }) => key);
}

/** @param {string} key @param {(trip: PlanTrip) => PlanTrip} change @param {boolean} [typing] */
const inTrip = (key, change, typing) =>
  edit((all) => all.map((trip) => (trip.key === key ? change(trip) : trip)), typing);

/** @param {string} key @param {string} name @param {unknown} value @param {boolean} typing */
export const setField = (key, name, value, typing) => inTrip(key, (trip) => withField(trip, name, value), typing);

/** @param {string} key @param {"item" | "parameters"} part @param {string} name @param {unknown} value @param {boolean} typing */
export const setIn = (key, part, name, value, typing) => inTrip(key, (trip) =>
  ({ ...trip, [part]: withField(trip[part] ?? {}, name, value) }), typing);

/** Set one coordinate: others may be writing the other ones. @param {string} key @param {0 | 1 | 2} axis @param {number | undefined} value @param {boolean} typing */
export const setAxis = (key, axis, value, typing) => inTrip(key, (trip) => {
  const target = [...(trip.target ?? [0, 0])];
  if (value === undefined) target.length = 2;
  else target[axis] = value;
  return { ...trip, target };
}, typing);

/** @param {string} key @param {string} name @param {Draft | null} draft */
export const setDraft = (key, name, draft) => plan.draft(selection.peek().key ?? "", key, name, draft);

/** Put pins elsewhere. @param {ReadonlyMap<string, Point>} targets @param {boolean} [typing] */
export function place(targets, typing = false) {
  const keys = free(targets.keys());
  if (!keys.length) return;
  for (const key of keys) ["x", "y"].forEach((name) => setDraft(key, name, null));
  edit((all) => all.map((trip) => {
    const target = keys.includes(trip.key) ? targets.get(trip.key) : undefined;
    return target ? { ...trip, target: [...target.slice(0, 2), ...(trip.target ?? []).slice(2)] } : trip;
  }), typing);
  const [first] = targets.values();
  if (first) speakOut(inWords(first));
}

/** Move the selected pins, in metres. @param {readonly string[]} keys @param {number} dx @param {number} dy */
export function nudge(keys, dx, dy) {
  /** @type {[string, Point][]} */
  const targets = trips().flatMap(({ key, target }) => (target && keys.includes(key)
    ? [[key, [rounded(target[0] + dx), rounded(target[1] + dy)]]] : []));
  place(new Map(targets), true);
}

/** @param {string} key @param {number} to */
export function move(key, to) {
  if (!free([key]).length || to < 0 || to >= trips().length) return;
  edit((all) => moved(all, key, to));
  speakOut(t("trips.moved", { n: to + 1 }));
}

/** Move in the order by one. @param {string} key @param {number} by */
export const shift = (key, by) => move(key, at(key) + by);

const BESIDE = 0.5; // metres between a pin and its copy

/** @param {readonly string[]} keys */
export function copy(keys) {
  if (isLocked.peek()) return;
  const originals = trips().filter(({ key }) => keys.includes(key));
  const fresh = originals.map(({ name: _, ...trip }) => ({ // no two trips have one name
    ...structuredClone(trip), key: newKey(),
    target: trip.target && [rounded(trip.target[0] + BESIDE), rounded(trip.target[1]), ...trip.target.slice(2)],
  }));
  put(fresh, at(originals.at(-1)?.key ?? "") + 1);
  markAll(fresh.map(({ key }) => key));
}

/** @param {readonly string[]} keys */
export function remove(keys) {
  const able = free(keys);
  const gone = trips().filter(({ key }) => able.includes(key));
  if (!gone.length) return null;
  const index = at(gone[0].key);
  const said = gone.length === 1
    ? t("trips.deleted", { n: index + 1, action: capital(gone[0].action) }) : t("trips.deleted-many", { n: gone.length });
  drawTelling(inSelected((all) => all.filter(({ key }) => !able.includes(key))), said);
  const next = trips()[index] ?? trips().at(-1);
  markOne(next?.key ?? null);
  return next?.key ?? null;
}

/** "3; 8.5": a comma may be that of the decimals. @param {Point} target */
export const where = (target) => target.map((one) => number(one, { maximumFractionDigits: 3, useGrouping: false })).join("; ");

/** The keys that a command on this pin is for: all that are selected, if it is one of them. @param {string} key */
export const meant = (key) => (marked.peek().includes(key) ? marked.peek() : [key]);
