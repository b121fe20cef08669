// Where the missions under way are going: the current target of each, with a line from its drone,
// and the whole way of the mission that is looked at.
import { svg } from "./dom.js";
import { attribute } from "./quick.js";
import { hasEnded } from "./standing.js";

function targetMark(floor, line, name, chosen) {
  const number = svg("text", { class: "m-index", y: 4, "text-anchor": "middle" });
  const mark = floor.mark(0, 0, svg("path", { class: "m-pin", d: "M0-9L9 0 0 9-9 0z" }), number);
  mark.classList.add("target");
  mark.setAttribute("data-own", "");
  mark.addEventListener("click", () => chosen.set(name));
  const write = Object.fromEntries(["x1", "y1", "x2", "y2"].map((a) => [a, attribute(line, a)]));
  return { mark, line, number, write, end: null, drone: null };
}

export function targets(floor, chosen) {
  const ways = floor.layer("ways");
  const lines = floor.layer("to-target");
  const layer = floor.layer("targets");
  const marks = new Map();
  const rows = new Map();
  const places = new Map();

  // Only of missions that have a drone: where all the others will go is on the page Trips.
  const showOne = (row) => {
    const aside = row.current === null || row.drone === null || hasEnded(row);
    const current = aside ? null : row.trips[row.current];
    let target = marks.get(row.name);
    if (!current || current[2] === null) {
      target?.mark.remove();
      target?.line.remove();
      marks.delete(row.name);
      return;
    }
    if (!target) {
      target = targetMark(floor, svg("line", { class: "m-line" }), row.name, chosen);
      target.number.textContent = String(row.index + 1);
      marks.set(row.name, target);
      layer.append(target.mark);
      lines.append(target.line);
    }
    const [, status, x, y] = current;
    if (target.end?.[0] !== x || target.end?.[1] !== y) {
      target.end = [x, y];
      floor.move(target.mark, x, y);
      target.write.x2(String(x));
      target.write.y2(String(y));
    }
    target.drone = status === "EXECUTING" ? row.drone : null;
    target.mark.classList.toggle("flying", target.drone !== null);
    lead(target);
    highlight(row.name);
  };
  // The line from the drone to the target; a mission without a drone has none.
  const lead = (target) => {
    const place = target.drone === null ? null : places.get(target.drone);
    const [x, y] = place ?? target.end;
    target.write.x1(String(x));
    target.write.y1(String(y));
  };
  const highlight = (name) => {
    const target = marks.get(name);
    if (!target) return;
    for (const each of [target.mark, target.line]) {
      each.classList.toggle("chosen", name === chosen.get());
    }
  };
  // The trips of the chosen mission, joined in their order.
  const showWay = () => {
    const row = rows.get(chosen.get());
    const stops = row ? row.trips.filter((trip) => trip[2] !== null) : [];
    const way = stops.map((trip) => `${trip[2]},${trip[3]}`).join(" ");
    const dots = stops.map(([, status, x, y]) => {
      const dot = floor.mark(x, y, svg("circle", { class: "m-stop", r: 4 }));
      dot.setAttribute("data-status", status);
      return dot;
    });
    ways.replaceChildren(svg("polyline", { class: "m-way", points: way }), ...dots);
  };

  const update = (missions, drones) => {
    const moved = new Set();
    for (const drone of drones) {
      places.set(drone.id, [drone.x, drone.y]);
      moved.add(drone.id);
    }
    for (const row of missions) {
      rows.set(row.name, row);
      showOne(row);
      if (row.name === chosen.get()) showWay();
    }
    if (moved.size) for (const each of marks.values()) if (moved.has(each.drone)) lead(each);
  };
  const clear = () => {
    for (const each of [marks, rows, places]) each.clear();
    for (const each of [ways, lines, layer]) each.replaceChildren();
  };
  chosen.watch((now, before) => {
    highlight(before);
    highlight(now);
    showWay();
  });
  return { update, clear };
}
