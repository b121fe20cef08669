// What moves beside the drones, on the map: the way of its last minute, where it was reported last, and who follows it.

import { h } from "preact";
import { number, t } from "../core/i18n.js";
import { Mark } from "./camera.js";
import { called, followed, silence } from "./tracked.js";

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
