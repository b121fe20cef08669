// The drones on the floor plan, live: where they are, their battery, and where they have been.
import { svg } from "./dom.js";
import { level } from "./battery.js";
import { attribute } from "./quick.js";

const TRAIL = 30; // seconds
const APART = 0.12; // metres between two points of a trail
const EVERY = 400; // ms between two drawings of the trails
const RADIUS = 9;
const AROUND = 2 * Math.PI * RADIUS;

function droneMark(floor, drone, chosen) {
  const arc = svg("circle", { class: "arc", r: RADIUS, transform: "rotate(-90)" });
  const label = svg("text", { class: "m-label", y: -15, "text-anchor": "middle" }, drone.id);
  const mark = floor.mark(
    drone.x,
    drone.y,
    svg("circle", { class: "m-reach", r: 18 }),
    svg("circle", { class: "m-back", r: RADIUS }),
    arc,
    svg("circle", { class: "m-body", r: 5.5 }),
    label,
  );
  mark.classList.add("drone");
  mark.setAttribute("data-own", "");
  const trail = svg("polyline", { class: "trail" });
  const write = {
    status: attribute(mark, "data-status"),
    level: attribute(arc, "data-level"),
    arc: attribute(arc, "stroke-dasharray"),
    chosen: attribute(mark, "data-chosen"),
    trail: attribute(trail, "data-chosen"),
    points: attribute(trail, "points"),
  };
  let row = drone;
  mark.addEventListener("click", () => row.mission && chosen.set(row.mission));
  let points = [];
  let [x, y] = [null, null];

  const show = (next, time) => {
    row = next;
    if (row.x !== x || row.y !== y) {
      [x, y] = [row.x, row.y];
      floor.move(mark, x, y);
      const last = points.at(-1);
      if (!last || Math.hypot(x - last[1], y - last[2]) >= APART) points.push([time, x, y]);
    }
    write.status(row.status);
    write.level(level(row.battery ?? 0));
    write.arc(`${((row.battery ?? 0) * AROUND).toFixed(1)} 99`);
    highlight();
  };
  const highlight = () => {
    const yes = chosen.get() !== null && row.mission === chosen.get();
    write.chosen(yes ? "yes" : null);
    write.trail(yes ? "yes" : null);
  };
  const redraw = (time) => {
    const first = points.findIndex((point) => point[0] >= time - TRAIL);
    if (first !== 0) points = first < 0 ? [] : points.slice(first);
    const text = points.map(([, px, py]) => `${px.toFixed(2)},${py.toFixed(2)}`);
    write.points(text.length ? `${text.join(" ")} ${x},${y}` : "");
  };
  return { mark, trail, show, highlight, redraw };
}

export function air(floor, chosen) {
  const trails = floor.layer("trails");
  const layer = floor.layer("drones");
  const marks = new Map();
  let drawn = 0;

  const update = (drones, state) => {
    for (const drone of drones) {
      let mark = marks.get(drone.id);
      if (!mark) {
        mark = droneMark(floor, drone, chosen);
        marks.set(drone.id, mark);
        layer.append(mark.mark);
        trails.append(mark.trail);
      }
      mark.show(drone, state.time);
    }
    const now = performance.now();
    if (now - drawn < EVERY) return;
    drawn = now;
    for (const mark of marks.values()) mark.redraw(state.time);
  };
  const clear = () => {
    marks.clear();
    layer.replaceChildren();
    trails.replaceChildren();
  };
  chosen.watch(() => {
    for (const mark of marks.values()) mark.highlight();
  });
  return { update, clear };
}
