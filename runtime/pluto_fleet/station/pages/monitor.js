// The page Monitor: missions, map, drones, the app's graph, console and results, each a panel.

import { download } from "./api.js";
import { bell, fill, h, keyed, many, put, set, shown, since, svg } from "./dom.js";
import { floorPlan } from "./floor.js";
import {
  battery, consoleView, ended, holdButton, level, mark, missionTable, question, resultsView, standing,
} from "./table.js";

const TRAIL = 30; // seconds
const APART = 0.12; // metres between two points of a trail
const TRAILS = 400; // ms between two drawings of the trails
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
  const show = ({ x, y, status, seen, battery: charge }, time) => {
    element.style.display = trail.style.display = x === null ? "none" : "";
    if (x === null) return; // where it is is not known
    const last = points.at(-1);
    if (!last || last[1] !== x || last[2] !== y) floor.move(element, x, y);
    if (!last || Math.hypot(x - last[1], y - last[2]) >= APART) points.push([time, x, y]);
    set(element, "data-status", status);
    set(element, "data-old", seen !== null && "yes");
    set(arc, "data-level", level(charge ?? 0));
    set(arc, "stroke-dasharray", `${((charge ?? 0) * AROUND).toFixed(1)} 99`);
  };
  const redraw = (time, { x, y }) => {
    if (x === null) points.length = 0;
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

function onTheMap({ live }, floor, chosen) {
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
    if (!drone || drone.x === null) return;
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
    if (performance.now() - drawn < TRAILS) return;
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
  const cut = holdButton(`Hold to cut motors of ${id}`, "cut",
    () => tell("cut-motors", { drone: id }));
  const why = h("small");
  const called = h("span", { class: "called" }, id, category && h("small", null, category));
  const doing = h("span", { class: "doing" }, stands, mission, why, cut);
  const element = h("li", null, called, doing, charge, trips, act);
  element.show = (row) => {
    stands.show(row.retired && row.status !== "LOST" ? "RETIRED" : row.status);
    charge.show(row.battery);
    put(trips, many(row.trips, "trip"));
    put(mission, row.mission ?? "");
    shown(mission, row.mission);
    const old = row.seen && `seen ${since(Math.max(0, live.made - row.seen) / 1000)} ago`;
    const at = old && `at ${row.x}, ${row.y}`;
    put(why, [row.why, at, old].filter(Boolean).join(" · "));
    shown(cut, row.z > 0.2);
    const word = away(row) ? "Bring back" : "Retire";
    put(act, word);
    set(act, "aria-label", `${word} drone ${id}`);
    shown(act, away(row) || live.state.phase === "flying");
    mark(element, row.mission && row.mission === chosen.name);
  };
  return element;
}

function droneList(context, chosen) {
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

const WIDE = matchMedia("(min-width: 1160px)");
const OFTEN = 250; // ms between two writings of what changes ten times a second

// Which mission is looked at: the table, the map and the graph show the same.
function choice({ plan, selected }) {
  const chosen = { name: null, changed: bell() };
  chosen.set = (name) => {
    if (name === chosen.name) return;
    chosen.name = name;
    const drawn = plan.missions.find((mission) => mission.name === name);
    if (drawn) selected.set(drawn.key);
    chosen.changed.ring();
  };
  return chosen;
}

// A part of the page, which its heading folds away; what was folded stays so.
function panel(id, title, { tools = [], body }) {
  const key = `pluto-folded-${id}`;
  const inside = h("div", { class: "inside", id: `${id}-inside` }, body);
  const beside = h("div", { class: "tools" }, tools);
  const toggle = h("button", {
    class: "fold", "aria-controls": inside.id, onclick: () => fold(!inside.hidden),
  }, h("span", { class: "arrow" }), title);
  const element = h("section", { class: `panel ${id}`, "aria-label": title },
    h("div", { class: "panel-head" }, h("h2", null, toggle), beside), inside);
  function fold(yes) {
    for (const each of [inside, beside]) shown(each, !yes);
    set(toggle, "aria-expanded", String(!yes));
    if (yes) sessionStorage.setItem(key, "yes");
    else sessionStorage.removeItem(key);
  }
  fold(sessionStorage.getItem(key) !== null);
  return element;
}

function questions(context) {
  const [heading, list] = [h("h2"), h("div")];
  const element = h("section", { class: "questions", role: "alert", hidden: true }, heading, list);
  element.update = () => {
    const rows = [...context.live.missions.values()].filter((row) => row.question);
    keyed(list, rows, (row) => `${row.name} ${row.question.text}`, (row) => question(context, row));
    put(heading, rows.length === 1 ? "A mission waits for you"
      : `${many(rows.length, "mission")} wait for you`);
    shown(element, rows.length);
  };
  return element;
}

export function monitor(context) {
  const { live, app } = context;
  const chosen = choice(context);
  const floor = floorPlan(app.map, app.drones);
  const save = (path) => h("button", {
    class: "button quiet small",
    onclick: async () => {
      try {
        await download(path, path.split("/").pop());
      } catch (error) {
        context.say(error.message, { bad: true });
      }
    },
  }, "Download");
  const table = missionTable(context, chosen);
  const map = onTheMap(context, floor, chosen);
  const drones = droneList(context, chosen);
  const graph = app.graph && graphView(context, chosen);
  const log = consoleView(context, save);
  const results = resultsView(context, chosen, floor, save);
  const asked = questions(context);
  const panels = {
    missions: panel("watch-missions", "Missions", table),
    map: panel("watch-map", "Map", { body: floor.element }),
    graph: graph && panel("watch-graph", "What the app does", graph),
    drones: panel("watch-drones", "Drones", drones),
    log: panel("watch-log", "Console", log),
    results: panel("watch-results", "Results", results),
  };
  const columns = [h("div", { class: "column main" }), h("div", { class: "column side" })];
  const element = h("div", { class: "monitor" }, asked, columns);
  // Moved, not painted over: the order for the keyboard is the one that is seen.
  function arrange() {
    const order = WIDE.matches ? ["missions graph log", "map drones results"]
      : ["missions map graph drones log results", ""];
    order.forEach((names, i) => {
      fill(columns[i], names.split(" ").map((name) => panels[name] ?? null));
    });
  }
  arrange();
  WIDE.addEventListener("change", arrange);

  let [flight, rows] = [null, null];
  let visible = false;
  let timer = 0;
  let seen = { log: 0, results: 0 };
  function newer(kind) {
    const list = live[kind];
    const first = list.findLastIndex((entry) => entry[0] <= seen[kind]) + 1;
    if (list.length) [seen[kind]] = list.at(-1);
    return list.slice(first);
  }
  function later() {
    timer = 0;
    drones.update();
    log.update(newer("log"));
    results.update(newer("results"));
  }
  function write(changes) {
    const again = live.flight === flight ? chosen.name : null;
    const anew = live.missions !== rows; // another flight, or the station was started again
    if (anew) {
      [flight, rows] = [live.flight, live.missions];
      seen = { log: 0, results: 0 };
      chosen.set(null);
      for (const each of [table, map, drones, graph, log, results]) each?.clear();
      changes = { missions: new Set(live.missions.keys()), drones: new Set(live.drones.keys()) };
    }
    for (const each of [table, map, graph]) each?.update(changes);
    if (anew && rows.has(again)) chosen.set(again);
    if (changes.missions.size) asked.update();
    timer ||= setTimeout(later, OFTEN);
  }
  return {
    element,
    update: (_, changes) => visible && write(changes),
    // What came while another page was open is made up for.
    show() {
      visible = true;
      write({ missions: new Set(live.missions.keys()), drones: new Set(live.drones.keys()) });
    },
    hide() {
      visible = false;
    },
  };
}

// The app's own graph as boxes and arrows, with the missions moving through it.

const LIT = 2500; // ms that an edge stays lit after a mission took it
const SEATS = 6; // tokens at a block; of more, the others are counted
const SIZE = 20;
const FOLLOWED = 30; // missions: of more, none could be followed, so none glides
const still = matchMedia("(prefers-reduced-motion: reduce)");
const HINT = "Numbers are missions. Point at a block, or press it, to read what it does.";

// finder(graph)(from, status, to, final) → the edges of the shortest way from one of the blocks
// `from`, left with a status, to `to`, reached with the final one; [] where no way fits, so that
// nothing is lit that cannot have been. Any block but a gate can turn what comes into that status.
export function finder({ blocks, edges }) {
  const gates = blocks.filter((block) => block.shape === "gate").map((block) => block.name);
  return (from, status, to, final) => {
    const found = new Map(from.map((block) => [`${block} ${status}`, { block, status, way: [] }]));
    for (const { block, status: now, way } of found.values()) { // it grows: the nearest come first
      for (const edge of edges) {
        if (edge.from !== block || !edge.statuses.includes(now)) continue;
        if (edge.to === to && now === final) return [...way, edge];
        for (const next of gates.includes(edge.to) ? [now] : [now, final]) {
          const [key, longer] = [`${edge.to} ${next}`, [...way, edge]];
          if (!found.has(key)) found.set(key, { block: edge.to, status: next, way: longer });
        }
      }
    }
    return [];
  };
}

// With which status a mission left where it was: what came of its trip, if it flew one.
function leftWith(before, row) {
  if (before.status !== "RUNNING") return before.status;
  if (row.status === "FAILED" || row.attempt > before.attempt) return "FAILED";
  return row.round > before.round || before.done + 1 >= before.total ? "COMPLETED" : "STANDBY";
}

function glide(token, edges) {
  const points = [...edges.flatMap((edge) => edge.points)];
  const far = [0];
  points.slice(1).forEach(([x, y], i) => {
    far.push(far[i] + Math.hypot(x - points[i][0], y - points[i][1]));
  });
  const frames = points.map(([x, y], i) => ({
    transform: `translate(${x - SIZE / 2}px, ${y - SIZE / 2}px)`,
    offset: (0.85 * far[i]) / (far.at(-1) || 1),
  }));
  token.animate([...frames, { transform: token.style.transform }],
    { duration: 600 + 150 * edges.length, easing: "ease-in-out" });
}

function tokens(graph, layer, chosen) {
  const here = new Map(graph.blocks.map((block) => [block.name, []])); // block → rows
  const made = new Map(); // "block mission" → token

  function seat(block, i, n) {
    const step = Math.min(SIZE + 2, Math.max(block.w + 36, 110) / n);
    const half = (step * (n - 1) + SIZE) / 2;
    const middle = Math.min(Math.max(block.x + block.w / 2, half), graph.width - half);
    const [x, y] = [middle + step * (i - (n - 1) / 2), block.y + block.h + 4];
    return `translate(${x - SIZE / 2}px, ${y - SIZE / 2}px)`;
  }
  function token(key, text, props) {
    if (!made.has(key)) {
      made.set(key, h("span", { class: "token", ...props }));
      layer.append(made.get(key));
    }
    return put(made.get(key), text);
  }
  // The chosen mission is always among them.
  function arrange(block) {
    const rows = here.get(block.name).sort((a, b) => a.index - b.index);
    const first = rows.slice(0, SEATS);
    const picked = rows.find((row) => row.name === chosen.name);
    if (picked && !first.includes(picked)) first[SEATS - 1] = picked;
    const seats = Math.min(rows.length, SEATS + 1);
    const kept = new Set(first.map((row, i) => {
      const choose = { title: row.name, onclick: () => chosen.set(row.name) };
      const one = token(`${block.name} ${row.name}`, row.index + 1, choose);
      one.style.transform = seat(block, i, seats);
      one.dataset.status = row.status;
      one.classList.toggle("picked", row === picked);
      return one;
    }));
    if (rows.length > SEATS) {
      const rest = token(block.name, `+${rows.length - SEATS}`, { "data-rest": "" });
      rest.style.transform = seat(block, SEATS, seats);
      kept.add(rest);
    }
    for (const [key, one] of made) {
      if ((key !== block.name && !key.startsWith(`${block.name} `)) || kept.has(one)) continue;
      one.remove();
      made.delete(key);
    }
  }
  // moves: [{ row, from: [names], to: [names], ways: [[name, edges]…] }], of so many missions
  function move(moves, missions) {
    const lively = missions <= FOLLOWED && !still.matches;
    layer.classList.toggle("lively", lively);
    const touched = new Set();
    for (const { row, from, to } of moves) {
      for (const name of from) {
        here.set(name, here.get(name).filter((other) => other.name !== row.name));
        touched.add(name);
      }
      for (const name of to) {
        here.get(name).push(row);
        touched.add(name);
      }
    }
    for (const block of graph.blocks) if (touched.has(block.name)) arrange(block);
    if (!lively || document.hidden) return;
    for (const { row, ways } of moves) {
      for (const [name, edges] of ways) {
        const one = made.get(`${name} ${row.name}`);
        if (one && edges.length) glide(one, edges);
      }
    }
  }
  function clear() {
    for (const name of here.keys()) here.set(name, []);
    made.clear();
    layer.replaceChildren();
  }
  chosen.changed.heard(() => graph.blocks.forEach(arrange));
  return { move, clear, at: (name) => here.get(name) };
}

function box({ name, kind, shape, x, y, w, h: height }) {
  const words = kind.replaceAll(/([a-z])([A-Z])/g, "$1 $2");
  const element = h("button", { class: `block ${shape}-block` }, h("b", null, name),
    kind && h("small", null, words));
  const { style } = element;
  [style.width, style.height] = [`${w}px`, `${height}px`];
  style.transform = `translate(${x}px, ${y}px)`;
  return element;
}

function path(points) {
  const near = ([x, y], [toX, toY]) => {
    const length = Math.hypot(toX - x, toY - y) || 1;
    const part = Math.min(8, length / 2) / length;
    return `${x + (toX - x) * part} ${y + (toY - y) * part}`;
  };
  return points.map((point, i) => {
    if (!i) return `M${point.join(" ")}`;
    const next = points[i + 1];
    if (!next) return `L${point.join(" ")}`;
    return `L${near(point, points[i - 1])}Q${point.join(" ")} ${near(point, next)}`;
  }).join("");
}

const head = (id) => svg("marker", {
  id, orient: "auto", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 8, markerHeight: 8,
  markerUnits: "userSpaceOnUse",
}, svg("path", { d: "M0 0L8 4L0 8z" }));

function graphView({ live, app: { graph } }, chosen) {
  const { width, height, blocks, edges } = graph;
  const boxes = new Map(blocks.map((block) => [block.name, box(block)]));
  const paths = new Map(edges.map((edge) => [edge, svg("path", {
    class: `edge ${edge.fork ? "fork" : ""} ${edge.dotted ? "dotted" : ""}`, d: path(edge.points),
  })]));
  const layer = h("div", { class: "tokens", "aria-hidden": "true" });
  const labels = edges.filter((edge) => edge.label).map(({ label: [x, y], statuses }) =>
    svg("text", { x, y, "text-anchor": "middle" }, statuses.join(", ").toLowerCase()));
  const stage = h("div", { class: "stage" },
    svg("svg", { width, height, "aria-hidden": "true" },
      svg("defs", null, head("head"), head("head-lit")), ...paths.values(), labels),
    ...boxes.values(), layer);
  const room = h("div", { class: "room" }, stage);
  const view = h("div", { class: "graph-view" }, room);
  new ResizeObserver(([{ contentRect }]) => {
    if (!contentRect.width) return;
    const whole = Math.max(460 / height, 7 / 8);
    const scale = Math.max(0.35, Math.min(contentRect.width / width, 1.25, whole));
    stage.style.transform = `scale(${scale})`;
    room.style.width = `${width * scale}px`;
    room.style.height = `${height * scale}px`;
  }).observe(view);

  const seats = tokens(graph, layer, chosen);
  const way = finder(graph);
  const stood = new Map(); // mission → its row before, and the blocks where it was
  const caption = h("p", { class: "caption" }, HINT);
  let read = null; // the block that is read now

  function say(block = read) {
    read = block;
    if (!block) {
      fill(caption, HINT);
      return;
    }
    const rows = seats.at(block.name);
    const names = rows.map((row) => row.name).join(", ");
    const who = rows.length && ` ${many(rows.length, "mission")} here: ${names}.`;
    fill(caption, h("strong", null, block.name), ` ${block.doc}`, who || null);
  }
  for (const block of blocks) {
    const element = boxes.get(block.name);
    for (const kind of ["pointerenter", "focus", "click"]) {
      element.addEventListener(kind, () => say(block));
    }
    for (const kind of ["pointerleave", "blur"]) element.addEventListener(kind, () => say(null));
  }
  function light(edge) {
    const element = paths.get(edge);
    clearTimeout(element.timer);
    element.classList.add("lit");
    element.timer = setTimeout(() => element.classList.remove("lit"), LIT);
  }
  // A mission that has not begun stands at the start.
  function blocksOf(row) {
    const at = row.at.filter((name) => boxes.has(name));
    if (at.length || !boxes.has("start")) return at;
    return row.status === "UNEXECUTED" ? ["start"] : ended(row) ? ["end"] : at;
  }
  function update({ missions }) {
    const moves = [];
    for (const name of missions) {
      const row = live.missions.get(name);
      const { blocks: from, before } = stood.get(name) ?? { blocks: [] };
      const to = blocksOf(row);
      stood.set(name, { blocks: to, before: row });
      const same = from.join() === to.join();
      if (same && before?.status === row.status) continue;
      const fresh = before ? to.filter((block) => !from.includes(block)) : [];
      moves.push({ row, from, to, ways: fresh.map((block) =>
        [block, way(from, leftWith(before, row), block, row.status)]) });
    }
    if (!moves.length) return;
    seats.move(moves, stood.size);
    for (const { ways } of moves) ways.forEach(([, taken]) => taken.forEach(light));
    count();
  }
  function count() {
    for (const { name, doc } of blocks) {
      const here = `${many(seats.at(name).length, "mission")} here`;
      set(boxes.get(name), "aria-label", `${name}: ${doc} ${here}`);
    }
    say();
  }
  function clear() {
    stood.clear();
    seats.clear();
    count();
  }
  clear();
  return { body: [view, caption], update, clear };
}
