// The station as this page knows it: its app, the flight, the plan, and what is selected, made once; and what the page
// tells its user in passing: at most one good and one bad message, and what is only read out.

import { computed, effect, signal } from "@preact/signals";
import { command, download, get, ofStation, pause, StationError, who } from "./api.js";
import { newKey } from "./changes.js";
import { t } from "./i18n.js";
import { LiveLine } from "./live.js";
import { PlanStore } from "./plan.js";
import { prefs } from "./prefs.js";
import { page } from "./route.js";
import { Undo } from "./undo.js";
import { World } from "./world.js";

const SHOWN_FOR = 6000; // ms
const UNDO_FOR = 20000; // ms

/** @type {Signal<Notice | null>} stays until it is put away */
export const badNotice = signal(null);
/** @type {Signal<Notice | null>} */
export const goodNotice = signal(null);
/** Only read out, by screen readers. */
export const spoken = signal("");

let timer = 0;

/**
 * Tell the user something.
 * @param {string} text
 * @param {{ bad?: boolean, isSaid?: boolean, undo?: (() => void) | null, settles?: boolean }} [how] settles: the bad one is over
 */
export function tell(text, { bad = false, isSaid = false, undo = null, settles = false } = {}) {
  if (settles) badNotice.value = null;
  (bad ? badNotice : goodNotice).value = { text, bad, isSaid, undo };
  if (bad) return;
  clearTimeout(timer);
  timer = setTimeout(() => { goodNotice.value = null; }, undo ? UNDO_FOR : SHOWN_FOR);
}

/** Read something out, and show nothing. @param {string} text */
export const speakOut = (text) => { spoken.value = text; };

const UNDO = "pluto-undo";
const LONGEST_UNDO = 1_000_000; // letters: browsers keep few more

/** The flight as it is now. */
export const world = new World();
/** @type {Signal<AppShape | null>} the app, once it is known */
export const app = signal(null);
/** Why the station cannot be seen: its token is missing, or it refuses. */
export const refusal = signal(/** @type {StationError | null} */ (null));
/** What was drawn on this page, to be taken back. */
export const undo = new Undo();
export const plan = new PlanStore(
  (text) => tell(text, { bad: true }), (before, after, typing) => undo.record(before, after, typing));

/** @type {Signal<Selected>} */
export const selection = signal({ key: null, mission: null, trip: null, drone: null });

/** Select a mission of the plan. @param {string | null} key @param {string | null} [trip] */
export function selectKey(key, trip = null) {
  const mission = plan.missions.peek().find((one) => one.key === key);
  selection.value = { key: mission ? key : null, mission: mission?.name ?? null, trip, drone: null };
}

/** Select a mission of the flight. @param {string | null} name @param {string | null} [trip] */
export function selectMission(name, trip = null) {
  const key = plan.missions.peek().find((one) => one.name === name)?.key ?? null;
  selection.value = { key, mission: name, trip, drone: null };
}

/** @param {string | null} drone */
export function selectDrone(drone) {
  selection.value = { key: null, mission: null, trip: null, drone };
}

/** The selected mission of the plan. */
export const selected = computed(() => plan.mission(selection.value.key));

effect(() => { // it was deleted, here or by another page
  const { key } = selection.peek();
  if (key && plan.isLoaded.value && !plan.mission(key)) selectKey(null);
});

/** Whether this browser may command; one that watches sees no buttons. */
export const mayFly = computed(() => app.value?.role !== "watch");

const browser = sessionStorage.getItem("pluto-browser") ?? newKey();
sessionStorage.setItem("pluto-browser", browser);
effect(() => { who.value = prefs.name.value; });

export const line = new LiveLine(world, {
  restarted: describeAgain,
  denied: () => { refusal.value = new StationError("", 401); },
  me: () => ({
    id: browser, name: prefs.name.peek(), page: page.peek(),
    touches: selection.peek().trip ?? selection.peek().key ?? "",
  }),
});

/** Learn what app this is; false: we may not know. */
async function describe() {
  for (;;) {
    try {
      app.value = await get("/api/app");
      return true;
    } catch (error) {
      if (error instanceof StationError && [401, 403].includes(error.status)) {
        refusal.value = error;
        return false;
      }
    }
    await pause(1000);
  }
}

// The station was started again: its app may be another by now.
async function describeAgain() {
  const shape = () => JSON.stringify({ ...app.peek(), server: "", sim: "", speed: "" });
  const was = shape();
  if (!await describe()) return;
  if (shape() !== was) location.reload();
  tell(t("live.restarted"));
  loadPlan();
}

let isLoading = false;
async function loadPlan() {
  if (isLoading) return;
  isLoading = true;
  await plan.load().catch(() => pause(500)); // asked again as long as the revisions differ
  isLoading = false;
}

/** Keep what can be undone over a reload, of the same station. */
function keepUndo() {
  const { server } = /** @type {AppShape} */ (app.peek());
  const kept = sessionStorage.getItem(UNDO) ?? "";
  if (kept.startsWith(server)) undo.restore(kept.slice(server.length));
  effect(() => {
    const text = (line.server.value || server) + undo.kept();
    if (text.length < LONGEST_UNDO) sessionStorage.setItem(UNDO, text);
    else sessionStorage.removeItem(UNDO);
  });
}

/** Begin to know the station. */
export async function connect() {
  if (!await describe()) return;
  keepUndo();
  line.keep();
  loadPlan();
  effect(() => { // a drone has joined
    const { known, fleet } = world.state.value;
    if (known && fleet !== app.peek()?.drones.length) describe();
  });
  effect(() => {
    const { known, plan: revision } = world.state.value;
    if (known && revision !== plan.revision && plan.isSaved) loadPlan();
  });
  window.addEventListener("beforeunload", (event) => {
    if (plan.trouble.peek()) event.preventDefault();
  });
}

/** Command the station, and tell what it says; returns whether it was done. @param {string} name @param {Record<string, unknown>} [given] */
export async function perform(name, given = {}) {
  try {
    tell(await command(name, given), { isSaid: true });
    return true;
  } catch (error) {
    return tellError(error);
  }
}

/** Tell what the station did not do. @param {unknown} error */
export function tellError(error) {
  const { message, isSaid } = ofStation(error);
  tell(message, { bad: true, isSaid });
  return false;
}

/** Save what the station has at an address. @param {string} path @param {string} name */
export const save = (path, name) => download(path, name).catch(tellError);
