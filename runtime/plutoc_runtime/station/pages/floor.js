// The floor plan: one SVG in metres, y upwards, that can be zoomed and moved. What stands on a layer
// by `mark` is drawn in pixels, y downwards, and keeps its size at every zoom; what has `data-own`
// keeps its pointers to itself.

import { h, svg } from "./dom.js";
import { ground, rulers, scaleBar } from "./floor_ground.js";

const CLOSEST = 800; // pixels a metre: one centimetre is easy to hit
const STEP = 60; // pixels that an arrow key moves the map
const between = (value, low, high) => Math.min(Math.max(value, low), high);

export function floorPlan(map, drones = []) {
  const [width, height] = map.size;
  const base = ground(map, drones);
  const edges = rulers(map.size);
  const bar = scaleBar();
  const world = svg("g", { class: "world" }, base.element);
  const picture = svg("svg", {
    class: "floor-picture", role: "application", tabindex: 0,
    "aria-label": `Floor plan, ${width} by ${height} metres. `
      + "Arrow keys move it, plus and minus zoom, 0 shows the whole map.",
  }, world, edges.element);
  const pointed = h("span", { class: "pointed num", "aria-hidden": "true" });
  const button = (text, label, onclick) =>
    h("button", { class: "button small", "aria-label": label, title: label, onclick }, text);
  const element = h("div", { class: "floor" }, picture,
    h("div", { class: "floor-foot row" }, pointed, bar.element,
      button("−", "Zoom out", () => zoom(1 / 1.4)), button("+", "Zoom in", () => zoom(1.4)),
      button("Whole map", "Show the whole map", () => whole())));

  let box = { width: 0, height: 0 };
  let view = { left: 0, bottom: 0, scale: 40 }; // where (0, 0) is, and how many pixels a metre takes
  let isWhole = true;
  let asked = 0;

  function draw() {
    asked = 0;
    const { left, bottom, scale } = view;
    world.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${left} ${bottom})`);
    picture.style.setProperty("--metre", 1 / scale);
    for (const part of [base, edges, bar]) part.redraw(view, box);
  }

  // The box's middle is always on the map, so that it cannot get lost.
  function look({ left, bottom, scale }, fitted = false) {
    const [x, y] = [box.width / 2, box.height / 2];
    view = {
      left: between(left, x - width * scale, x), bottom: between(bottom, y, y + height * scale), scale,
    };
    isWhole = fitted;
    asked ||= requestAnimationFrame(draw);
  }
  const fitting = () => Math.max(0.01, Math.min((box.width - 56) / width, (box.height - 62) / height));
  function whole() {
    const scale = fitting();
    look({
      left: (box.width + 22 - width * scale) / 2, bottom: (box.height - 28 + height * scale) / 2, scale,
    }, true);
  }
  function zoom(factor, at = { x: box.width / 2, y: box.height / 2 }) {
    const scale = between(view.scale * factor, fitting() * 0.7, Math.max(CLOSEST, fitting()));
    const by = scale / view.scale;
    look({ left: at.x - (at.x - view.left) * by, bottom: at.y - (at.y - view.bottom) * by, scale });
  }
  const move = (dx, dy) => look({ ...view, left: view.left + dx, bottom: view.bottom + dy });

  const inside = (event) => {
    const at = picture.getBoundingClientRect();
    return { x: event.clientX - at.left, y: event.clientY - at.top };
  };
  function toMetres(event) {
    const { x, y } = inside(event);
    return { x: (x - view.left) / view.scale, y: (view.bottom - y) / view.scale };
  }
  const toPixels = (x, y) => ({ x: view.left + x * view.scale, y: view.bottom - y * view.scale });

  for (const kind of ["pointermove", "pointerleave", "dragover"]) {
    picture.addEventListener(kind, (event) => {
      const { x, y } = toMetres(event);
      pointed.textContent = kind !== "pointerleave" && between(x, 0, width) === x
        && between(y, 0, height) === y ? `x ${x.toFixed(2)} m   y ${y.toFixed(2)} m` : "";
    });
  }
  hands(picture, inside, { zoom, move, whole });

  new ResizeObserver(() => {
    const before = box;
    const now = { width: picture.clientWidth, height: picture.clientHeight };
    if (!now.width || !now.height) return; // it is hidden
    box = now;
    if (isWhole) whole();
    else move((now.width - before.width) / 2, (now.height - before.height) / 2);
  }).observe(picture);

  const floor = {
    element, picture, toMetres, toPixels,
    layer(name) {
      const layer = svg("g", { class: `layer ${name}` });
      world.append(layer);
      return layer;
    },
    mark: (x, y, ...parts) =>
      floor.move(svg("g", { class: "mark" }, svg("g", { class: "keeps-size" }, parts)), x, y),
    move(mark, x, y) {
      mark.setAttribute("transform", `translate(${x} ${y})`);
      return mark;
    },
    // Moves the map so that this place is well inside the box.
    reveal(x, y) {
      const at = toPixels(x, y);
      const into = (value, length) => between(value, 60, Math.max(60, length - 60)) - value;
      const [dx, dy] = [into(at.x, box.width), into(at.y, box.height)];
      if (box.width && (dx || dy)) move(dx, dy);
    },
  };
  const homes = floor.layer("homes");
  for (const { id, home: [x, y] } of drones) {
    homes.append(floor.mark(x, y, svg("title", {}, `Home of ${id}`),
      svg("path", { d: "M-6 6V-1L0 -7L6 -1V6Z" }), svg("text", { class: "name", y: 20 }, id)));
  }
  return floor;
}

// The wheel and two fingers zoom; dragging the ground moves it, and so do the arrow keys.
function hands(picture, inside, { zoom, move, whole }) {
  const fingers = new Map();
  const on = (kinds, act) => kinds.split(" ").forEach((kind) =>
    picture.addEventListener(kind, act, { passive: false }));

  on("wheel", (event) => {
    event.preventDefault();
    zoom(1.0015 ** -(event.deltaY * (event.deltaMode ? 30 : 1)), inside(event));
  });
  on("pointerdown", (event) => {
    if (event.button || event.target.closest("[data-own]")) return;
    fingers.set(event.pointerId, inside(event));
    picture.setPointerCapture(event.pointerId);
  });
  on("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = inside(event);
    const other = [...fingers.values()].find((finger) => finger !== before);
    const half = other ? 2 : 1; // the middle between two fingers moves half as far as one of them
    move((now.x - before.x) / half, (now.y - before.y) / half);
    if (other) {
      const apart = (one) => Math.max(10, Math.hypot(one.x - other.x, one.y - other.y));
      zoom(apart(now) / apart(before), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
    }
    fingers.set(event.pointerId, now);
  });
  on("pointerup pointercancel", (event) => fingers.delete(event.pointerId));
  on("keydown", (event) => {
    const act = event.target === picture && !event.ctrlKey && !event.metaKey && !event.altKey && {
      ArrowLeft: () => move(STEP, 0), ArrowRight: () => move(-STEP, 0),
      ArrowUp: () => move(0, STEP), ArrowDown: () => move(0, -STEP),
      "+": () => zoom(1.4), "=": () => zoom(1.4), "-": () => zoom(1 / 1.4), 0: whole,
    }[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
