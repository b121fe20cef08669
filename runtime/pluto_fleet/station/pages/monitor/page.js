// The Monitor: the map with all that flies, and beside it missions, drones, console and graph.

import { h } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { app, selectDrone, selection, world } from "../core/station.js";
import { Camera } from "../map/camera.js";
import { Fleet, Homes, Names } from "../map/fleet.js";
import { Floor } from "../map/floor.js";
import { landmarkNames, Landmarks, North } from "../map/landmarks.js";
import { MapSplit } from "../ui/map_split.js";
import { Tabs } from "../ui/parts.js";
import { Console } from "./console.js";
import { DroneCard, DroneList } from "./drones.js";
import { Graph } from "./graph.js";
import { MissionList } from "./missions.js";
import { Questions } from "./questions.js";
import { Targets } from "./targets.js";

const LISTS = /** @type {const} */ (["missions", "drones", "log", "graph"]);
/** @typedef {typeof LISTS[number]} ListName */

/**
 * The Monitor of a world: live, or of a replay, in which nothing can be commanded.
 * @param {{ world: World, live: boolean, foot?: ComponentChildren }} props
 */
export function Watch({ world: seen, live, foot }) {
  const shape = /** @type {AppShape} */ (app.value);
  const camera = useMemo(() => new Camera(shape.map.size), [shape]);
  const { drone, mission } = selection.value;
  useEffect(() => { // who presses a name anywhere sees it on the map
    const row = seen.drones.rows.get(drone ?? seen.missions.rows.get(mission ?? "")?.peek().drone ?? "")?.peek();
    if (row && row.x !== null && row.y !== null) camera.reveal(row.x, row.y);
  }, [drone, mission, seen, camera]);
  const lists = LISTS.filter((name) => name !== "graph" || (shape.graph && prefs.graph.value));
  const list = lists.find((name) => name === prefs.railTab.value) ?? "missions";
  return h(MapSplit, {
    stage: [
      h(Floor, {
        key: "floor", map: shape.map, camera,
        overlay: [h(Names, { key: "names", world: seen, chosen: drone, more: landmarkNames }), h(North, { key: "north" })],
        children: [
          h(Landmarks, { key: "landmarks" }),
          h(Homes, { key: "homes", app: shape }),
          h(Targets, { key: "targets", world: seen, chosen: mission }),
          h(Fleet, { key: "fleet", world: seen, chosen: drone, onPick: selectDrone }),
        ],
      }),
      live && h(Questions, { key: "questions", world: seen }),
      drone && h(DroneCard, { key: "card", world: seen, id: drone, live }),
      foot,
    ],
    rail: [
      h(Tabs, {
        key: "tabs", label: t("rail"), names: lists, now: list, title: (/** @type {ListName} */ name) => t(`monitor.${name}`),
        onPick: (/** @type {ListName} */ name) => { prefs.railTab.value = name; },
      }),
      h("div", { key: "body", class: "rail-body", role: "tabpanel", "aria-label": t(`monitor.${list}`) }, {
        missions: () => h(MissionList, { world: seen, live }),
        drones: () => h(DroneList, { world: seen, live }),
        log: () => h(Console, { world: seen, live }),
        graph: () => h(Graph, { world: seen }),
      }[list]()),
    ],
  });
}

export default function Monitor() {
  return h(Watch, { world, live: true });
}
