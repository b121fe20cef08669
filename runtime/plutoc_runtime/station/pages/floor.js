// The floor plan: one SVG in metres, y upwards, that can be zoomed and moved. What `mark` puts on a
// layer is drawn in pixels, y downwards, and keeps its size at every zoom; what has `data-own` has
// its pointers to itself.

import { token } from "./api.js";
import { button, h, set, svg, unique } from "./dom.js";

const CLOSEST = 800; // pixels a metre: one centimetre is easy to hit
const STEP = 60; // pixels that an arrow key moves the map
const between = (value, low, high) => Math.min(Math.max(value, low), high);

export function floorPlan(map, drones = []) {
  const [width, height] = map.size;
  const base = ground(map);
  const edges = rulers(map.size);
  const bar = scaleBar();
  const world = svg("g", { class: "world" }, base.element);
  const picture = svg("svg", {
    class: "floor-picture", role: "application", tabindex: 0,
    "aria-label": `Floor plan, ${width} by ${height} metres. `
      + "Arrow keys move it, plus and minus zoom, 0 shows the whole map.",
  }, world, edges.element);
  const pointed = h("span", { class: "pointed num", "aria-hidden": "true" });
  const element = h("div", { class: "floor" }, picture,
    h("div", { class: "floor-foot row" }, pointed, bar.element,
      set(button("−", () => zoom(1 / 1.4), "icon"), "aria-label", "Zoom out"),
      set(button("+", () => zoom(1.4), "icon"), "aria-label", "Zoom in"),
      button("Whole map", () => whole(), "small")));

  let box = { width: 0, height: 0 };
  let view = { left: 0, bottom: 0, scale: 40 }; // where (0, 0) is, and a metre's pixels
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
      left: between(left, x - width * scale, x),
      bottom: between(bottom, y, y + height * scale),
      scale,
    };
    isWhole = fitted;
    asked ||= requestAnimationFrame(draw);
  }
  const fitting = () =>
    Math.max(0.01, Math.min((box.width - 56) / width, (box.height - 62) / height));
  function whole() {
    const scale = fitting();
    const left = (box.width + 22 - width * scale) / 2;
    look({ left, bottom: (box.height - 28 + height * scale) / 2, scale }, true);
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
    homes.append(floor.mark(x, y, svg("path", { d: "M-6 6V-1L0 -7L6 -1V6Z" },
      svg("title", {}, `Home of ${id}`))));
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

let fetched = null;

// The address of the map's picture, or null. Where the station has a token, the picture needs it.
export function mapPicture({ image }) {
  fetched ??= !image || !token() ? Promise.resolve(image)
    : fetch(image, { headers: { Authorization: `Bearer ${token()}` } })
      .then((answer) => answer.blob()).then(URL.createObjectURL).catch(() => null);
  return fetched;
}

function ground(map) {
  const [width, height] = map.size;
  const hatch = svg("pattern", {
    id: unique("no-fly"), class: "hatch", patternUnits: "userSpaceOnUse", width: 10, height: 10,
  }, svg("rect", { width: 10, height: 10 }),
  svg("path", { d: "M-2 12L12 -2M-2 2L2 -2M8 12L12 8" }));
  const grid = svg("path", { class: "grid" });
  const picture = svg("image", {
    class: "picture", width, height, preserveAspectRatio: "none",
    transform: `translate(0 ${height}) scale(1 -1)`,
  });
  mapPicture(map).then((address) => {
    if (!address) return;
    set(picture, "href", address);
    const probe = new Image();
    probe.onload = () => picture.classList.toggle("paper-like", isPaper(probe));
    probe.src = address;
  });
  const areas = map.no_fly.map((corners, at) =>
    svg("polygon", { class: "no-fly", points: corners.join(" "), fill: `url(#${hatch.id})` },
      svg("title", {}, `No-fly area ${at + 1}`)));
  const element = svg("g", { class: map.image ? "ground pictured" : "ground" },
    svg("defs", {}, hatch), svg("rect", { class: "paper", width, height }), picture, grid, areas,
    svg("rect", { class: "rim", width, height }));
  return {
    element,
    redraw(view, box) {
      const { scale, left, bottom } = view;
      set(hatch, "patternTransform", `scale(${1 / scale})`);
      const across = lines(scale, 28, -left, box.width - left, width);
      const upwards = lines(scale, 28, bottom - box.height, bottom, height);
      set(grid, "d", across.map((x) => `M${x} 0V${height}`).join("")
        + upwards.map((y) => `M0 ${y}H${width}`).join(""));
    },
  };
}

// In the dark a picture that is mostly white, as drawings are, is turned over.
function isPaper(picture) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 8, height: 8 });
  const brush = canvas.getContext("2d");
  brush.fillStyle = "white";
  brush.fillRect(0, 0, 8, 8);
  brush.drawImage(picture, 0, 0, 8, 8);
  try {
    return brush.getImageData(0, 0, 8, 8).data.reduce((sum, one) => sum + one) > 200 * 256;
  } catch {
    return false; // some browsers do not let drawings be looked at
  }
}

// The least of 1, 2, 5, 10, 20, … (and 0.5, 0.2, …) metres that takes so many pixels.
function step(scale, pixels) {
  const power = 10 ** Math.floor(Math.log10(pixels / scale));
  const factor = [1, 2, 5, 10].find((one) => one * power * scale > pixels - 0.01);
  return Number((power * factor).toPrecision(3));
}

// Where lines are, in metres, of those that are seen.
function lines(scale, apart, from, to, length) {
  const every = step(scale, apart);
  const found = [];
  const last = Math.min(to / scale, length) / every + 1e-6;
  for (let n = Math.max(0, Math.ceil(from / scale / every)); n <= last; n += 1) {
    found.push(Number((n * every).toFixed(3)));
  }
  return found;
}

function rulers([width, height]) {
  const element = svg("g", { class: "rulers", "aria-hidden": "true" });
  const tick = (x, y, d, text, place) =>
    svg("g", { transform: `translate(${x} ${y})` }, svg("path", { d }), svg("text", place, text));
  return {
    element,
    redraw({ scale, left, bottom }, box) {
      const upwards = lines(scale, 44, bottom - box.height + 24, bottom - 12, height);
      const wide = 7.5 * Math.max(0, ...upwards.map((metres) => String(metres).length)) + 12;
      const x = Math.min(Math.max(left, wide), box.width - 4);
      const y = Math.min(Math.max(bottom, 20), box.height - 20);
      element.replaceChildren(
        ...lines(scale, 56, 24 - left, box.width - 8 - left, width).map((metres) =>
          tick(left + metres * scale, y, "M0 0v5", metres, { y: 17 })),
        ...upwards.map((metres) =>
          tick(x, bottom - metres * scale, "M0 0h-5", metres, { x: -8, y: 4, class: "left" })));
    },
  };
}

function scaleBar() {
  const line = svg("path");
  const text = svg("text", { y: 9 });
  const element = svg("svg", { class: "scale-bar", height: 20, role: "img" }, line, text);
  return {
    element,
    redraw({ scale }) {
      const metres = step(scale, 56);
      set(line, "d", `M1 12v5h${metres * scale}v-5`);
      set(text, "x", 1 + metres * scale / 2);
      text.textContent = `${metres} m`;
      set(element, "width", Math.ceil(metres * scale) + 4);
      set(element, "aria-label", `Scale bar: ${metres} metres`);
    },
  };
}

// What is wrong with a place while something is dragged there; the station has the last word.
export function whyNot({ size: [width, height], no_fly: areas }, [x, y]) {
  if (x < 0 || y < 0 || x > width || y > height) return "Outside the map";
  return areas.some((area) => isInside(x, y, area)) ? "In a no-fly area" : "";
}

function isInside(x, y, corners) {
  let within = false;
  corners.forEach(([ax, ay], at) => {
    const [bx, by] = corners.at(at - 1);
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) * (bx - ax)) / (by - ay)) within = !within;
  });
  return within;
}
