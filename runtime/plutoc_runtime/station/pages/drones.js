// The drones, live on the floor plan with where they are going, and as a list.

import { h, keyed, many, put, set, shown, svg } from "./dom.js";
import { battery, ended, level, mark, standing, sureButton } from "./table.js";

const TRAIL = 30; // seconds
const APART = 0.12; // metres between two points of a trail
const OFTEN = 400; // ms between two drawings of the trails
const AROUND = 2 * Math.PI * 9;
const FEW = 8; // drones whose names have room on the map

function droneMark(floor, { id }, choose) {
  const arc = svg("circle", { class: "arc", r: 9, transform: "rotate(-90)" });
  const element = floor.mark(0, 0,
    svg("circle", { class: "reach", r: 18 }), svg("circle", { class: "back", r: 9 }), arc,
    svg("circle", { class: "core", r: 5.5 }),
    svg("text", { y: -15, "text-anchor": "middle" }, id));
  set(element, "class", "mark drone");
  set(element, "data-own", "");
  element.addEventListener("click", () => choose(id));
  const trail = svg("polyline", { class: "trail" });
  const points = [];
  const show = ({ x, y, status, battery: charge }, time) => {
    const last = points.at(-1);
    if (!last || last[1] !== x || last[2] !== y) floor.move(element, x, y);
    if (!last || Math.hypot(x - last[1], y - last[2]) >= APART) points.push([time, x, y]);
    set(element, "data-status", status);
    set(arc, "data-level", level(charge ?? 0));
    set(arc, "stroke-dasharray", `${((charge ?? 0) * AROUND).toFixed(1)} 99`);
  };
  const redraw = (time, { x, y }) => {
    while (points[0]?.[0] < time - TRAIL) points.shift();
    const text = points.map((point) => `${point[1]},${point[2]}`).join(" ");
    set(trail, "points", text && `${text} ${x},${y}`);
  };
  return { element, trail, show, redraw };
}

function targetMark(floor, row, chosen) {
  const number = svg("text", { y: 4, "text-anchor": "middle" }, row.index + 1);
  const element = floor.mark(0, 0, svg("path", { d: "M0-10L10 0 0 10-10 0z" }), number);
  set(element, "class", "mark target");
  set(element, "data-own", "");
  element.addEventListener("click", () => chosen.set(row.name));
  return { element, line: svg("line"), row };
}

export function onTheMap({ live }, floor, chosen) {
  const names = ["way", "trails", "to-target", "targets", "drones"];
  const layers = names.map((name) => floor.layer(name));
  const [way, trails, lines, targets, drones] = layers;
  const marks = new Map();
  const goals = new Map(); // mission → where it goes now

  function aim(name) {
    const row = live.missions.get(name);
    const trip = row && row.drone && !ended(row) ? row.trips[row.current] : null;
    let goal = goals.get(name);
    if (!trip) {
      goal?.element.remove();
      goal?.line.remove();
      goals.delete(name);
      return;
    }
    if (!goal) {
      goal = targetMark(floor, row, chosen);
      goals.set(name, goal);
      targets.append(goal.element);
      lines.append(goal.line);
      mark(goal.element, name === chosen.name);
    }
    Object.assign(goal, { row, flies: trip[1] === "EXECUTING" });
    const [, , x, y] = trip;
    if (goal.x !== x || goal.y !== y) {
      floor.move(goal.element, x, y);
      set(goal.line, "x2", x);
      set(goal.line, "y2", y);
      Object.assign(goal, { x, y });
    }
    lead(goal);
  }
  // The line from its drone, while that is on its way.
  function lead({ row, line, flies }) {
    const drone = live.drones.get(row.drone);
    set(line, "visibility", flies && drone ? null : "hidden");
    if (!drone) return;
    set(line, "x1", drone.x);
    set(line, "y1", drone.y);
  }
  function highlight() {
    const row = live.missions.get(chosen.name);
    const stops = row ? row.trips : [];
    way.replaceChildren(
      svg("polyline", { points: stops.map((trip) => `${trip[2]},${trip[3]}`).join(" ") }),
      ...stops.map((trip) => floor.mark(trip[2], trip[3], svg("circle", { r: 4 }))));
    for (const [name, goal] of goals) mark(goal.element, name === chosen.name);
    for (const [id, { element, trail }] of marks) {
      const its = row && live.drones.get(id).mission === row.name;
      for (const each of [element, trail]) mark(each, its);
    }
  }
  const choose = (id) => live.drones.get(id).mission && chosen.set(live.drones.get(id).mission);
  let drawn = 0;
  function update(changes) {
    for (const id of changes.drones) {
      const drone = live.drones.get(id);
      if (!marks.has(id)) {
        marks.set(id, droneMark(floor, drone, choose));
        drones.append(marks.get(id).element);
        trails.append(marks.get(id).trail);
        floor.element.classList.toggle("few", marks.size <= FEW);
      }
      marks.get(id).show(drone, live.state.time);
    }
    for (const name of changes.missions) aim(name);
    for (const goal of goals.values()) if (changes.drones.has(goal.row.drone)) lead(goal);
    if (chosen.name && changes.missions.has(chosen.name)) highlight();
    if (performance.now() - drawn < OFTEN) return;
    drawn = performance.now();
    for (const [id, { redraw }] of marks) redraw(live.state.time, live.drones.get(id));
  }
  function clear() {
    marks.clear();
    goals.clear();
    for (const layer of layers) layer.replaceChildren();
  }
  chosen.changed.heard(highlight);
  return { update, clear };
}

function droneLine({ tell, app, live }, id, chosen) {
  const category = app.categories.length > 1 && app.drones.find((one) => one.id === id)?.category;
  const [stands, charge, trips] = [standing(), battery(), h("span", { class: "muted" })];
  const now = () => live.drones.get(id);
  const mission = h("button", { class: "link", onclick: () => chosen.set(now().mission) });
  const away = (row) => row.retired || row.status === "LOST";
  const act = h("button", {
    class: "button quiet small",
    onclick: () => tell(away(now()) ? "bring-back" : "retire", { drone: id }),
  });
  const cut = sureButton(`Cut motors of ${id}`, () => tell("cut-motors", { drone: id }));
  const why = h("small");
  const called = h("span", { class: "called" }, id, category && h("small", null, category));
  const doing = h("span", { class: "doing" }, stands, mission, why, cut);
  const element = h("li", null, called, doing, charge, trips, act);
  element.show = (row) => {
    stands.show(row.retired ? "RETIRED" : row.status);
    charge.show(row.battery);
    put(trips, many(row.trips, "trip"));
    put(mission, row.mission ?? "");
    shown(mission, row.mission);
    put(why, row.why);
    shown(cut, row.z > 0.2);
    const word = away(row) ? "Bring back" : "Retire";
    put(act, word);
    set(act, "aria-label", `${word} drone ${id}`);
    shown(act, live.state.phase === "flying");
    mark(element, row.mission && row.mission === chosen.name);
  };
  return element;
}

export function droneList(context, chosen) {
  const list = h("ul", { class: "drone-lines" });
  const empty = h("p", { class: "empty" }, "The drones are here as soon as missions fly.");
  const update = () => {
    keyed(list, [...context.live.drones.values()], (row) => row.id,
      (row) => droneLine(context, row.id, chosen), (line, row) => line.show(row));
    shown(empty, !list.childElementCount);
  };
  chosen.changed.heard(update);
  return { body: [empty, list], update, clear: update };
}
