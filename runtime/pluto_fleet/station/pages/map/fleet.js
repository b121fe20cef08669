// The drones on the map, each with its battery, the way it came and where it is bound, and their names.

import { computed, effect } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { percent, t, tOr } from "../core/i18n.js";
import { useCalm } from "../ui/hooks.js";
import { Mark, Tags, useCamera } from "./camera.js";
import { way } from "./routes.js";
import { trackNames } from "./tracked.js";
import { toPixels } from "./view.js";

const TAIL = 30; // seconds of the way that it came
const ROUND = 2 * Math.PI * 10; // pixels around the ring of the battery
const LABELS_EVERY = 60; // ms
const BAD = ["LOST"];

/** The homes of the drones. @param {{ app: AppShape }} props */
export const Homes = ({ app }) => h("g", { class: "layer homes" },
  app.drones.map(({ id, home: [x, y] }) => h(Mark, { key: id, x, y },
    h("path", { d: "M-6 6V-1L0 -7L6 -1V6Z" }, h("title", null, t("map.home", { drone: id }))))));

/** Where a mission's drone is bound: its present trip's target, if that stands. @param {MissionRow | undefined} mission */
function target(mission) {
  const trip = mission && mission.current !== null ? mission.trips[mission.current] : undefined;
  return trip?.track ? undefined : trip;
}

/** @param {{ world: World, chosen: string | null, onPick: (id: string) => void }} props chosen: the selected drone */
export function Fleet({ world, chosen, onPick }) {
  return h("g", { class: "layer fleet" },
    world.drones.keys.value.map((id) => h(Drone, { key: id, world, id, isChosen: id === chosen, onPick })));
}

/** @param {{ world: World, id: string, isChosen: boolean, onPick: (id: string) => void }} props */
function Drone({ world, id, isChosen, onPick }) {
  const row = /** @type {DroneRow} */ (world.drones.get(id));
  const to = useMemo(() => computed(() => {
    const drone = world.drones.get(id);
    const trip = drone?.mission ? target(world.missions.get(drone.mission)) : undefined;
    return trip ? `${trip.x} ${trip.y}` : "";
  }), [world, id]);
  const bound = to.value;
  const from = useRef(/** @type {{ bound: string, at: number[] }} */ ({ bound: "", at: [] }));
  const { x, y } = row;
  if (x === null || y === null) return null;
  if (from.current.bound !== bound) from.current = { bound, at: [x, y] }; // it sets out from here
  const goal = bound.split(" ").map(Number);
  const route = bound ? way([from.current.at, goal]) ?? [from.current.at, goal] : [];
  const status = tOr(`status.${row.status}`, row.status);
  return h("g", { class: `drone ${isChosen ? "chosen" : ""}`, "data-status": row.status, "data-drone": id },
    bound && h("polyline", { class: "bound", points: route.map(([px, py]) => `${px},${py}`).join(" ") }),
    h(Tail, { world, id }),
    h(Mark, { x, y }, h("g", {
      role: "button", tabindex: 0, "data-own": true, class: "drone-mark",
      "aria-label": t("map.drone", { drone: id, status, battery: percent(row.battery) }),
      onClick: () => onPick(id),
      onKeyDown: (/** @type {KeyboardEvent} */ event) => {
        if (!["Enter", " "].includes(event.key)) return;
        event.preventDefault();
        onPick(id);
      },
    },
    h("circle", { class: "touch", r: 20 }), h("circle", { class: "body", r: 8 }),
    h("circle", { class: "ring", r: 10 }),
    row.battery !== null && h("circle", {
      class: `ring level ${row.battery < 0.2 ? "bad" : ""}`, r: 10,
      "stroke-dasharray": `${ROUND * row.battery} ${ROUND}`, transform: "rotate(-90)",
    }),
    BAD.includes(row.status) && h("path", { class: "cross", d: "M-4 -4L4 4M4 -4L-4 4" }),
    row.status === "UNKNOWN" && h("text", { class: "asks", y: 4 }, "?"))));
}

/** The way of the last half minute. @param {{ world: World, id: string }} props */
function Tail({ world, id }) {
  const line = useRef(/** @type {SVGPolylineElement | null} */ (null));
  useEffect(() => {
    /** @type {[number, number, number][]} */
    let points = [];
    return effect(() => {
      const row = world.drones.get(id);
      const { time } = world.state.peek();
      if (!row || row.x === null || row.y === null) return;
      const [last] = points.slice(-1);
      if (last && time < last[0]) points = []; // a replay went back
      points = points.filter(([at]) => at > time - TAIL);
      points.push([time, row.x, row.y]);
      line.current?.setAttribute("points", points.map(([, px, py]) => `${px},${py}`).join(" "));
    });
  }, [world, id]);
  return h("polyline", { ref: line, class: "tail" });
}

/** @param {DroneRow} row @param {string | null} chosen @returns {number} */
function importance({ id, status, mission }, chosen) {
  if (id === chosen) return 4;
  if (BAD.includes(status)) return 3;
  return mission ? 2 : 1;
}

/**
 * The drones' names, laid out anew a few times a second; those that are lost are always named.
 * @param {{ world: World, chosen: string | null, more?: (view: View, box: Box) => Label[] }} props more: names in metres of other things
 */
export function Names({ world, chosen, more }) {
  const camera = useCamera();
  const labels = useMemo(() => computed(() => {
    const [view, box] = [camera.view.value, camera.box.value];
    const drones = world.drones.all().filter(({ x }) => x !== null).map((row) => ({
      key: `drone ${row.id}`, text: row.id, gap: 14, kind: BAD.includes(row.status) ? "bad" : "",
      importance: importance(row, chosen), always: BAD.includes(row.status) || row.id === chosen,
      ...toPixels(view, row.x ?? 0, row.y ?? 0),
    }));
    const others = [...more?.(view, box) ?? [], ...trackNames(world)].map((label) => ({ ...label, ...toPixels(view, label.x, label.y) }));
    return { labels: [...drones, ...others], box, marks: drones.map(({ x, y }) => ({ x, y, r: 10 })) };
  }), [world, chosen, camera, more]);
  return h(Tags, useCalm(labels, LABELS_EVERY).value);
}
