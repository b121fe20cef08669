// Where missions are bound: the present trip of each, and the whole way of the selected one.

import { h } from "preact";
import { selectMission } from "../core/station.js";
import { hasEnded } from "../core/world.js";
import { Mark } from "../map/camera.js";

/** @param {{ world: World, chosen: string | null }} props */
export function Targets({ world, chosen }) {
  const way = world.missions.get(chosen)?.trips ?? [];
  return h("g", { class: "layer targets" },
    way.length > 1 && h("polyline", { class: "way", points: way.map(({ x, y }) => `${x},${y}`).join(" ") }),
    way.map(({ x, y, status }, at) => h(Mark, { key: at, x, y },
      h("circle", { class: `stop ${status === "COMPLETED" ? "done" : ""}`, r: 4 }))),
    world.missions.keys.value.map((name) => h(Target, { key: name, world, name, isChosen: name === chosen })));
}

/** @param {{ world: World, name: string, isChosen: boolean }} props */
function Target({ world, name, isChosen }) {
  const row = world.missions.get(name);
  if (!row?.drone || hasEnded(row) || row.current === null) return null;
  const { x, y } = row.trips[row.current];
  return h(Mark, { x, y, class: `target ${isChosen ? "chosen" : ""}` },
    h("g", { "data-own": true, onClick: () => selectMission(name) },
      h("title", null, name), h("path", { d: "M0-10L10 0 0 10-10 0z" }), h("text", { y: 4 }, row.index + 1)));
}
