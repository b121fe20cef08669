// The Monitor: the map with all that flies and where it is bound, what only a person can know above it, and
// beside it missions, drones, console and graph.

import { h } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { t, tOr } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { app, mayFly, perform, selectDrone, selection, selectMission, world as live } from "../core/station.js";
import { hasEnded } from "../core/world.js";
import { Camera, Mark } from "../map/camera.js";
import { Fleet, Homes, Names } from "../map/fleet.js";
import { Floor, MapSplit } from "../map/floor.js";
import { landmarkNames, Landmarks, North } from "../map/ground.js";
import { Dots, Drawn, useMarks } from "../map/many.js";
import { Tracks } from "../map/tracks.js";
import { MOST_MARKS } from "../map/view.js";
import { Button, Icon, SaidWords, SureButton, Tabs } from "../ui/parts.js";
import { Console } from "./console.js";
import { DroneCard, DroneList } from "./drones.js";
import { EventList, mattered, picking } from "./events.js";
import { Graph } from "./graph.js";
import { MissionList } from "./missions.js";

/** Where a trip leads; what it follows may not be known any more. @param {World} world @param {TripRow} trip */
const spot = (world, trip) => (trip.track ? world.tracks.get(trip.track) : trip);

/** @param {{ x: number, y: number }} one */
const placeOf = ({ x, y }) => [x, y];

/** @param {{ status: string }} trip */
const isDone = ({ status }) => status === "COMPLETED";

/** @param {{ world: World, chosen: string | null }} props */
export function Targets({ world, chosen }) {
  const trips = world.missions.get(chosen)?.trips ?? [];
  const way = trips.flatMap((trip) => {
    const at = spot(world, trip);
    return at ? [{ x: at.x, y: at.y, status: trip.status }] : [];
  });
  const legs = way.slice(1).map(({ x, y }, at) => `M${way[at].x} ${way[at].y}L${x} ${y}`);
  const marks = useMarks(way, placeOf);
  return h("g", { class: "layer targets" },
    h(Drawn, { class: `way ${legs.length < MOST_MARKS ? "" : "long"}`, parts: legs }), // so many dashes take long to be painted
    way.length > MOST_MARKS && [
      h(Dots, { key: "all", places: way.map(placeOf) }),
      h(Dots, { key: "done", class: "done", places: way.filter(isDone).map(placeOf) }),
    ],
    marks.map(({ x, y, status }, at) => h(Mark, { key: at, x, y },
      h("circle", { class: `stop ${isDone({ status }) ? "done" : ""}`, r: 4 }))),
    world.missions.keys.value.map((name) => h(Target, { key: name, world, name, isChosen: name === chosen })));
}

/** @param {{ world: World, name: string, isChosen: boolean }} props */
function Target({ world, name, isChosen }) {
  const row = world.missions.get(name);
  if (!row?.drone || hasEnded(row) || row.current === null) return null;
  const at = spot(world, row.trips[row.current]);
  if (!at) return null;
  const { x, y } = at;
  return h(Mark, { x, y, class: `target ${isChosen ? "chosen" : ""}` },
    h("g", { "data-own": true, onClick: () => selectMission(name) },
      h("title", null, name), h("path", { d: "M0-10L10 0 0 10-10 0z" }), h("text", { y: 4 }, row.index + 1)));
}

/** @param {{ world: World }} props */
export function Questions({ world }) {
  const rows = world.missions.all().filter(({ question }) => question !== null);
  return h("section", { class: "questions", role: "alert", hidden: !rows.length },
    rows.length > 0 && h("h2", null, h(Icon, { name: "warning" }), t("monitor.wait-for-you", { n: rows.length })),
    rows.map((row) => h(Asked, { key: row.name, row, question: /** @type {Question} */ (row.question) })));
}

/** @param {{ row: MissionRow, question: Question }} props */
function Asked({ row: { name }, question: { said, answers } }) {
  const decide = (/** @type {string} */ answer) => { perform("decide", { mission: name, answer }); };
  return h("div", { class: "question" },
    h("p", null, h("button", { type: "button", class: "link", onClick: () => selectMission(name) }, name), ": ", h(SaidWords, { words: said })),
    mayFly.value && h("div", { class: "row" }, answers.map((answer) => (answer === "cancel"
      ? h(SureButton, { key: answer, label: t("monitor.cancel"), sure: t("monitor.cancel-sure"), onSure: () => decide(answer) })
      : h(Button, { key: answer, onClick: () => decide(answer) }, tOr(`answer.${answer}`, answer))))));
}

const LISTS = /** @type {const} */ (["missions", "drones", "events", "log", "graph"]);
/** @typedef {typeof LISTS[number]} ListName */

/**
 * The Monitor of a world: live, or of a replay, in which nothing can be commanded.
 * @param {{ world: World, isLive: boolean, foot?: ComponentChildren }} props
 */
export function Watch({ world, isLive, foot }) {
  const shape = /** @type {AppShape} */ (app.value);
  const camera = useMemo(() => new Camera(shape.map.size), [shape]);
  const { drone, mission } = selection.value;
  useEffect(() => { // who presses a name anywhere sees it on the map
    const row = world.drones.rows.get(drone ?? world.missions.rows.get(mission ?? "")?.peek().drone ?? "")?.peek();
    if (row && row.x !== null && row.y !== null) camera.reveal(row.x, row.y);
  }, [drone, mission, world, camera]);
  useEffect(() => () => { picking.value = null; }, []);
  const has = { graph: shape.graph && prefs.graph.value, events: shape.events.length || world.events.all().some(mattered) };
  const lists = LISTS.filter((name) => !(name in has) || has[/** @type {keyof typeof has} */ (name)]);
  const list = lists.find((name) => name === prefs.railTab.value) ?? "missions";
  return h(MapSplit, {
    stage: [
      h(Floor, {
        key: "floor", map: shape.map, camera, class: picking.value ? "aiming" : "", onPlace: (at) => picking.peek()?.(at),
        overlay: [h(Names, { key: "names", world, chosen: drone, more: landmarkNames }), h(North, { key: "north" })],
        children: [
          h(Landmarks, { key: "landmarks" }),
          h(Homes, { key: "homes", app: shape }),
          h(Tracks, { key: "tracks", world }),
          h(Targets, { key: "targets", world, chosen: mission }),
          h(Fleet, { key: "fleet", world, chosen: drone, onPick: selectDrone }),
        ],
      }),
      isLive && h(Questions, { key: "questions", world }),
      drone && h(DroneCard, { key: "card", world, id: drone, live: isLive }),
      foot,
    ],
    rail: [
      h(Tabs, {
        key: "tabs", label: t("rail"), names: lists, now: list, title: (/** @type {ListName} */ name) => t(`monitor.${name}`),
        onPick: (/** @type {ListName} */ name) => { prefs.railTab.value = name; },
      }),
      h("div", { key: "body", class: "rail-body", role: "tabpanel", "aria-label": t(`monitor.${list}`) }, {
        missions: () => h(MissionList, { world, live: isLive }),
        drones: () => h(DroneList, { world, live: isLive }),
        events: () => h(EventList, { world, live: isLive }),
        log: () => h(Console, { world, live: isLive }),
        graph: () => h(Graph, { world }),
      }[list]()),
    ],
  });
}

export default function Monitor() {
  return h(Watch, { world: live, isLive: true });
}
