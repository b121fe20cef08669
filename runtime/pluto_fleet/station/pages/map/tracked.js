// What moves beside the drones, in words: what was not reported for a while is called as it was seen last, for where it
// is now is not known. Pure.

import { plain, roughly, t } from "../core/i18n.js";

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
