// What moves beside the drones, on the map: the way of its last minute, where it was reported last, and who follows it.
// What was not reported for a while is dimmed, and says since when: where it is now is not known.

import { h } from "preact";
import { number, plain, roughly, t } from "../core/i18n.js";
import { Mark } from "./camera.js";

const FRESH = 3; // seconds for which a report says where something is

/** Seconds since it was reported, if that is too long ago to know where it is; else 0. @param {TrackRow} row @param {number} time */
export const silence = ({ seen }, time) => (time - seen > FRESH ? time - seen : 0);

/** What it is called, and since when nothing is known of it. @param {TrackRow} row @param {number} time */
export function called(row, time) {
  const name = `${plain(row.kind)} ${row.id}`.trim();
  const since = silence(row, time);
  return since ? t("track.seen", { name, time: roughly(since) }) : name;
}

/** The names of all that is tracked, to be laid out with others. @param {World} world */
export function trackNames(world) {
  const { time } = world.state.value;
  return world.tracks.all().map((row) => ({
    key: `track ${row.id}`, text: called(row, time), x: row.x, y: row.y, gap: 12, importance: 2.5,
    kind: silence(row, time) ? "old" : "tracked",
  }));
}

/** The track that a drone's trip follows. @param {World} world @param {DroneRow | undefined} drone @returns {string | undefined} */
export function followed(world, drone) {
  const mission = world.missions.get(drone?.mission);
  return mission && mission.current !== null ? mission.trips[mission.current].track : undefined;
}

/** @param {{ world: World }} props */
export const Tracks = ({ world }) => h("g", { class: "layer tracks" },
  world.tracks.keys.value.map((id) => h(Track, { key: id, world, id })),
  world.drones.keys.value.map((id) => h(Pursuit, { key: `by ${id}`, world, id })));

/** @param {{ world: World, id: string }} props */
function Track({ world, id }) {
  const row = /** @type {TrackRow} */ (world.tracks.get(id));
  const { x, y, trail } = row;
  const { time } = world.state.value;
  const where = t("track.at", { name: called(row, time), x: number(x), y: number(y) });
  return h("g", { class: `tracked ${silence(row, time) ? "old" : ""}`, "data-track": id },
    h("polyline", { class: "trail", points: [...trail, [x, y]].join(" ") }),
    h(Mark, { x, y }, h("rect", { role: "img", "aria-label": where, x: -6, y: -6, width: 12, height: 12, rx: 3 }, h("title", null, where))));
}

/** From a drone to what it follows. @param {{ world: World, id: string }} props */
function Pursuit({ world, id }) {
  const drone = world.drones.get(id);
  const track = world.tracks.get(followed(world, drone));
  if (!track || !drone || drone.x === null || drone.y === null) return null;
  return h("line", { class: "pursuit", "data-drone": id, x1: drone.x, y1: drone.y, x2: track.x, y2: track.y });
}
