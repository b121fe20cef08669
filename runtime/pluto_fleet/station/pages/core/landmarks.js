// What people have drawn on the map: named places and zones, and where the floor plan lies. Kept at the
// station, in the fleet file.

import { effect, signal } from "@preact/signals";
import { get, ofStation, send } from "./api.js";
import { typeOf } from "./drawings.js";
import { degrees } from "./earth.js";
import { number, t } from "./i18n.js";
import { tell, tellError, world } from "./station.js";

const AGAIN = 3000; // ms

export const landmarks = signal(/** @type {MapData | null} */ (null));

/** Latitude and longitude of a place on the map, for people; empty where it does not lie on the Earth. @param {readonly number[]} place */
export function onEarth(place) {
  const plane = landmarks.value?.plane;
  if (!plane) return "";
  return degrees(plane, place).map((one) => `${number(one, DEGREES)}°`).join("; ");
}
const DEGREES = { minimumFractionDigits: 6, maximumFractionDigits: 6 };

let asked = -1; // the revision that was asked for last
/** @param {number} revision */
async function load(revision) {
  if (asked === revision) return;
  asked = revision;
  try {
    landmarks.value = await get("/api/map");
  } catch (error) {
    ofStation(error);
    setTimeout(() => { asked = -1; }, AGAIN);
  }
}

/** Know the map as it is, and as others change it. */
export function followMap() {
  effect(() => {
    const { known, map } = world.state.value;
    if (known && landmarks.peek()?.revision !== map) load(map);
  });
}

/** Change the map; another page that was quicker is told of, and its map is shown. @param {(map: MapData) => Partial<MapData>} change */
export async function changeMap(change) {
  const before = landmarks.peek();
  if (!before) return false;
  const { revision, places, zones, north, image } = { ...before, ...change(before) };
  const placed = image && { x: image.x, y: image.y, width: image.width, height: image.height, turn: image.turn };
  return sent(() => send("PUT", "/api/map", { revision, places, zones, north, ...(placed ? { image: placed } : {}) }));
}

/** Lay a floor plan under the map. @param {File} file */
export function uploadPlan(file) {
  const query = new URLSearchParams({ revision: String(landmarks.peek()?.revision ?? 0), name: file.name });
  return sent(() => send("PUT", `/api/map/image?${query}`, file, { type: file.type, timeout: 60000 }));
}

/** Take the places and zones of another program's drawing. @param {File} file */
export function uploadDrawing(file) {
  const query = new URLSearchParams({ revision: String(landmarks.peek()?.revision ?? 0), file: file.name });
  return sent(() => send("PUT", `/api/map/drawing?${query}`, file, { type: typeOf(file.name) }));
}

/** @param {() => Promise<{ status: number, data: MapData }>} ask */
async function sent(ask) {
  try {
    const { status, data } = await ask();
    landmarks.value = data;
    if (status === 409) tell(t("map.changed-meanwhile"), { bad: true });
    return status === 200;
  } catch (error) {
    return tellError(error);
  }
}
