// The floor plan: one SVG in metres, y upwards, that can be zoomed and moved; what stands on it.
//
//   const floor = floorPlan(app.map, app.drones);
//   page.append(floor.element);              // it fills whatever box it is in
//   const drones = floor.layer("drones");    // a <g> in metres; later layers are above
//   const mark = floor.mark(2, 1.5, …);      // a <g> at a place; its children are drawn in pixels
//   drones.append(mark);                     //   (y downwards) and keep their size at every zoom
//   floor.move(mark, 2.1, 1.5);
//
// An element with `data-own` keeps its pointers to itself: dragging it does not move the map.

import { h, svg } from "./dom.js";
import { ground } from "./floor_ground.js";
import { hands } from "./floor_hands.js";
import { rulers, scaleBar } from "./floor_rulers.js";
import * as views from "./floor_view.js";

export function floorPlan(map, drones = []) {
  const { size } = map;
  const base = ground(map, drones);
  const edges = rulers(size);
  const bar = scaleBar();
  const world = svg("g", { class: "world" }, base.element);
  const picture = svg("svg", {
    class: "floor-picture", role: "application", tabindex: 0,
    "aria-label": `Floor plan, ${size[0]} by ${size[1]} metres. `
      + "Arrow keys move it, plus and minus zoom, 0 shows the whole map.",
  }, world, edges.element);
  const pointed = h("output", { class: "pointed", "aria-hidden": "true" });
  const button = (text, label, act) => {
    const made = h("button", { type: "button", "aria-label": label, title: label }, text);
    made.addEventListener("click", act);
    return made;
  };
  const element = h("div", { class: "floor" },
    picture,
    h("div", { class: "floor-foot" }, pointed, bar.element,
      h("div", { class: "floor-buttons", role: "group", "aria-label": "Zoom" },
        button("−", "Zoom out", () => zoom(1 / 1.4)),
        button("+", "Zoom in", () => zoom(1.4)),
        button("Whole map", "Show the whole map", () => show()))));

  let box = { width: 0, height: 0 };
  let view = { left: 0, bottom: 0, scale: 40 };
  let isWhole = true;
  let asked = 0;
  const watchers = [];

  const draw = () => {
    asked = 0;
    const { left, bottom, scale } = view;
    world.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${left} ${bottom})`);
    picture.style.setProperty("--metre", 1 / scale);
    picture.classList.toggle("roomy", roomy(drones, scale));
    base.redraw(view, box);
    edges.redraw(view, box);
    bar.redraw(view);
    watchers.forEach((watcher) => watcher(view));
  };
  const change = (next, fitted = false) => {
    view = next;
    isWhole = fitted;
    asked ||= requestAnimationFrame(draw);
  };
  const middle = () => ({ x: box.width / 2, y: box.height / 2 });
  const zoom = (factor, at = middle()) => change(views.zoomed(view, factor, at, size, box));
  const show = () => change(views.whole(size, box), true);
  const shift = (dx, dy) => change(views.moved(view, dx, dy, size, box));

  const toMetres = (event) => {
    const place = picture.getBoundingClientRect();
    return views.toMetres(view, { x: event.clientX - place.left, y: event.clientY - place.top });
  };
  const tell = (event) => {
    const place = event.type === "pointerleave" ? null : toMetres(event);
    const onMap = place && place.x >= 0 && place.y >= 0 && place.x <= size[0] && place.y <= size[1];
    pointed.textContent = onMap ? `x ${place.x.toFixed(2)} m   y ${place.y.toFixed(2)} m` : "";
  };
  for (const kind of ["pointermove", "pointerleave", "dragover"]) {
    picture.addEventListener(kind, tell);
  }
  hands(picture, { zoom, move: shift, whole: show });

  new ResizeObserver(() => {
    const { width, height } = picture.getBoundingClientRect();
    if (!width || !height) return; // it is hidden
    const before = box;
    box = { width, height };
    if (isWhole) show();
    else shift((width - before.width) / 2, (height - before.height) / 2);
  }).observe(picture);

  const floor = {
    element,
    picture, // the SVG itself, for listeners
    size,
    get scale() { return view.scale; }, // pixels a metre
    toMetres, // of a pointer event
    toPixels: (x, y) => views.toPixels(view, { x, y }), // from the picture's upper left
    whole: show,
    watch: (watcher) => watchers.push(watcher), // called with {left, bottom, scale} when it changes
    layer(name) {
      const layer = svg("g", { class: `layer ${name}` });
      world.append(layer);
      return layer;
    },
    mark(x, y, ...parts) {
      const mark = svg("g", { class: "mark" }, svg("g", { class: "keeps-size" }, ...parts));
      return floor.move(mark, x, y);
    },
    move(mark, x, y) {
      mark.setAttribute("transform", `translate(${x} ${y})`);
      return mark;
    },
    /** Move the map so that this place is well inside the box. */
    reveal(x, y) {
      const at = views.toPixels(view, { x, y });
      const into = (value, length) => Math.min(Math.max(value, 60), length - 60) - value;
      const [dx, dy] = [into(at.x, box.width), into(at.y, box.height)];
      if (box.width && (dx || dy)) shift(dx, dy);
    },
  };
  const homes = floor.layer("homes");
  for (const { drone, parts } of base.homes) {
    homes.append(floor.mark(drone.home[0], drone.home[1], ...parts));
  }
  return floor;
}

/** Whether the homes are far enough from each other for their names to be written below them. */
function roomy(drones, scale) {
  const wide = 7 * Math.max(0, ...drones.map((drone) => drone.id.length)) + 6;
  return drones.every((one, index) => drones.slice(index + 1).every((other) => {
    const [dx, dy] = [0, 1].map((axis) => Math.abs(one.home[axis] - other.home[axis]) * scale);
    return dx > wide || dy > 27;
  }));
}
