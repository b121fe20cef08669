// The floor plan: one SVG in metres, y upwards, that can be zoomed and moved. What `mark` puts on a
// layer is drawn in pixels, y downwards, and keeps its size at every zoom; what has `data-own` has
// its pointers to itself.

import { token } from "./api.js";
import { button, fill, h, icon, keyed, plain, put, set, svg, unique } from "./dom.js";

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
    picture.classList.toggle("whole", fitted); // there a finger scrolls the page
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
    if (!now.width || !now.height) return; // hidden
    box = now;
    if (isWhole) whole();
    else move((now.width - before.width) / 2, (now.height - before.height) / 2);
    draw(); // in this frame
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

// The least of 1, 2, 5, 10, … metres that takes so many pixels.
function step(scale, pixels) {
  const power = 10 ** Math.floor(Math.log10(pixels / scale));
  const factor = [1, 2, 5, 10].find((one) => one * power * scale > pixels - 0.01);
  return Number((power * factor).toPrecision(3));
}

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

// Of what is being dragged; the station has the last word.
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

// Putting trips on it. Actions are dragged there, or taken in hand by pressing one and put down by
// pressing a place or writing x and y; pins are dragged, or moved with the arrow keys.

const BESIDE = 25; // pixels between pins at one place
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const apart = (one, other) =>
  Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
const round = (value, step) => Number((Math.round(value / step) * step).toFixed(2));

export const metres = (target) => target.map((one) => Number(one.toFixed(3))).join(", ");

function snapped(floor, { clientX, clientY, shiftKey }, dx = 0, dy = 0) {
  const { x, y } = floor.toMetres({ clientX: clientX - dx, clientY: clientY - dy });
  return [x, y].map((one) => round(one, shiftKey ? 0.01 : 0.1));
}

// act: { choose(key), drag(key, target | null), place(key, target), remove(key), open(key) }
export function pins(floor, act) {
  const [faint, lines, layer] = ["other-trips", "path", "pins"].map(floor.layer);
  const start = svg("polyline", { class: "from-home" });
  const way = svg("polyline");
  lines.append(start, way);
  let isLocked = false;
  let others = "";

  function make({ key }) {
    const pin = svg("g", { role: "button", tabindex: 0, "data-own": "", "data-key": key },
      svg("circle", { class: "halo", r: 20 }), svg("circle", { class: "disc", r: 12.5 }),
      svg("text", { y: 4.5 }),
      svg("path", { class: "pin-sign", d: "M11 -20L19 -5H3ZM11 -15v5M11 -8v.5" }),
      svg("g", { class: "pin-words" },
        svg("rect", { rx: 9, height: 20, y: 20 }), svg("text", { y: 34 })));
    pin.onfocus = () => act.choose(key);
    held(floor, pin, key, act, () => isLocked);
    return floor.mark(0, 0, pin);
  }

  // trips: [{ key, number, target, words, trouble }…]
  function update({ trips, chosen, locked, home }) {
    isLocked = locked;
    const placed = trips.filter(({ target }) => target);
    const taken = new Map();
    keyed(layer, placed, ({ key }) => key, make, (mark, trip) => {
      const pin = mark.firstChild.firstChild;
      const [x, y] = trip.target;
      const at = `${x.toFixed(1)} ${y.toFixed(1)}`;
      const before = taken.get(at) ?? 0;
      taken.set(at, before + 1);
      pin.trip = trip;
      pin.beside = before * BESIDE;
      floor.move(mark, x, y);
      set(pin, "transform", `translate(${pin.beside} 0)`);
      set(pin, "class", ["pin", trip.key === chosen && "chosen", trip.trouble && "bad",
        trip.key === "new" && "new"].filter(Boolean).join(" "));
      set(pin, "aria-label", `Trip ${trip.number}: ${trip.words}, at ${metres([x, y])} metres.`
        + (trip.trouble && ` Problem: ${trip.trouble}`)
        + (locked ? "" : " Arrow keys move it, Delete removes it, Enter opens its card."));
      put(pin.children[2], trip.number);
      const [plate, words] = pin.lastChild.children;
      put(words, trip.words.length > 28 ? `${trip.words.slice(0, 27)}…` : trip.words);
      const width = words.textContent.length * 7.2 + 14; // more or less
      set(plate, "width", width);
      set(plate, "x", -width / 2);
    });
    const kept = placed.filter(({ key }) => key !== "new");
    const points = kept.map(({ target }) => target.slice(0, 2));
    set(way, "points", points.join(" "));
    set(start, "points", points.length && home && `${home.slice(0, 2)} ${points[0]}`);
  }

  // Those of other missions, faintly: [[words, [x, y]]…]
  function showOthers(places) {
    if (JSON.stringify(places) === others) return;
    others = JSON.stringify(places);
    faint.replaceChildren(...places.map(([words, [x, y]]) =>
      floor.mark(x, y, svg("circle", { r: 5 }, svg("title", {}, words)))));
  }
  return { update, showOthers };
}

function held(floor, pin, key, act, isLocked) {
  let drag = null; // where it was taken, and how far from its middle
  const end = (event) => {
    if (!drag) return;
    const { target } = drag;
    drag = null;
    if (target && event.type === "pointerup") act.place(key, target);
    else if (target) act.drag(key, null);
  };
  pin.onpointerdown = (event) => {
    if (event.button) return;
    event.preventDefault();
    pin.focus();
    if (isLocked()) return;
    const at = pin.querySelector(".disc").getBoundingClientRect();
    drag = {
      event, dx: event.clientX - at.left - at.width / 2, dy: event.clientY - at.top - at.height / 2,
    };
    pin.setPointerCapture(event.pointerId);
  };
  pin.onpointermove = (event) => {
    if (!drag || (!drag.target && apart(event, drag.event) < 4)) return;
    drag.target = snapped(floor, event, drag.dx, drag.dy);
    act.drag(key, drag.target);
  };
  for (const kind of ["pointerup", "pointercancel", "lostpointercapture"]) {
    pin.addEventListener(kind, end);
  }
  pin.onkeydown = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape" && drag) end(event);
    else if (event.key === "Enter" || event.key === " ") act.open(key);
    else if (isLocked()) return;
    else if (event.key in ARROWS) {
      const by = ARROWS[event.key].map((one) => one * (event.shiftKey ? 1 : 0.1));
      const target = by.map((one, axis) => round(pin.trip.target[axis] + one, 0.01));
      pin.trip = { ...pin.trip, target }; // the next press may come before it is drawn anew
      act.place(key, target);
    } else if (event.key === "Delete") act.remove(key);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
}

const SIGNS = {
  take_photo: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
  measure: "M10 4.5a2 2 0 014 0v9.2a4 4 0 11-4 0zM12 9v7.5",
  pick_item: "M5 15v5h14v-5M12 15V4M7 9l5-5 5 5",
  release_item: "M5 15v5h14v-5M12 4v11M7 10l5 5 5-5",
};
const STAR = "M12 4l2.3 5.2 5.7.6-4.2 3.9 1.2 5.6-5-2.9-5 2.9 1.2-5.6L4 9.8l5.7-.6z";

// "take_photo" is "Take photo".
export const called = (name) => plain(name).replace(/^./, (first) => first.toUpperCase());
export const actionSign = (name) => icon(SIGNS[name] ?? STAR);

// act: { add(action, target), hover(action, target | null) }
export function actions(app, floor, act) {
  const { picture } = floor;
  let inHand = null;
  let pressed = null; // where a press on the map began: a drag moves the map

  const chips = app.actions.map((action) => {
    // Not a <button>: those cannot be dragged in every browser.
    const chip = h("div", {
      class: "action button", role: "button", tabindex: 0, draggable: "true",
      "data-action": action.name, onclick: () => take(inHand === action ? null : action),
      onkeydown(event) {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        take(action);
        x.focus();
      },
    }, actionSign(action.name), called(action.name));
    byMouse(floor, chip, action, act, () => take(null));
    byFinger(floor, chip, action, act, () => take(null));
    return chip;
  });
  const said = h("p", { class: "hint" });
  const [x, y] = ["x", "y"].map((axis) =>
    h("input", {
      class: "input", inputmode: "decimal", required: true, pattern: "-?\\d+([.,]\\d+)?",
      title: "metres, such as 2.5", "aria-label": axis,
    }));
  const form = h("form", {
    class: "row",
    onsubmit(event) {
      event.preventDefault();
      act.add(inHand, [x, y].map(({ value }) => Number(value.replace(",", "."))));
      form.reset();
      back();
    },
  }, "x", x, "y", y, "m", h("button", { class: "button primary" }, "Add"),
  set(button("Cancel", () => back(), "quiet"), "type", "button"));
  const element = h("section", {
    class: "card actions", "aria-label": "Actions",
    onkeydown: ({ key }) => key === "Escape" && inHand && back(),
  }, h("div", { class: "row", role: "group", "aria-label": "Actions to put on the map" }, chips),
  h("div", { class: "in-hand row" }, said, form));

  function take(action) {
    inHand = action;
    chips.forEach((chip, at) => set(chip, "aria-pressed", String(app.actions[at] === inHand)));
    picture.classList.toggle("aiming", inHand);
    form.hidden = !inHand;
    fill(said, inHand
      ? [h("strong", {}, called(inHand.name)), ": press a place on the map, or write"]
      : "Drag an action onto the map. Or press it, then press where on the map.");
    if (!inHand) act.hover(null, null);
  }

  function back() {
    const chip = chips[app.actions.indexOf(inHand)];
    take(null);
    chip.focus();
  }

  picture.addEventListener("pointerdown", (event) => { pressed = event.isPrimary && event; });
  picture.addEventListener("pointermove", (event) => {
    if (inHand && event.pointerType === "mouse") act.hover(inHand, snapped(floor, event));
  });
  picture.addEventListener("pointerup", (event) => {
    if (!inHand || !pressed) return;
    if (apart(event, pressed) > 6) return;
    act.add(inHand, snapped(floor, event));
    take(null);
  });
  picture.addEventListener("keydown", ({ key }) => key === "Escape" && inHand && back());
  take(null);
  return { element, putBack: () => take(null) };
}

function byMouse(floor, chip, action, act, begin) {
  const { picture } = floor;
  let dragging = false; // only what was taken here may be dropped
  const over = (kind, heard) => picture.addEventListener(kind, (event) => {
    if (!dragging) return;
    event.preventDefault();
    heard(snapped(floor, event), event);
  });
  chip.addEventListener("dragstart", ({ dataTransfer }) => {
    dragging = true;
    dataTransfer.setData("text/plain", chip.textContent);
    dataTransfer.effectAllowed = "copy";
    begin();
  });
  chip.addEventListener("dragend", () => {
    dragging = false;
    act.hover(action, null);
  });
  over("dragover", (target) => act.hover(action, target));
  over("dragleave", (_, event) => picture.contains(event.relatedTarget) || act.hover(action, null));
  over("drop", (target) => act.add(action, target));
}

// Browsers have no drag and drop for fingers.
function byFinger(floor, chip, action, act, begin) {
  let from = null;
  let ghost = null;
  const target = (event) => {
    const box = floor.picture.getBoundingClientRect();
    return event.clientX > box.left && event.clientX < box.right && event.clientY > box.top
      && event.clientY < box.bottom ? snapped(floor, event) : null;
  };
  chip.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse") return;
    chip.draggable = false; // else a long press begins the browser's own
    from = event;
    chip.setPointerCapture(event.pointerId);
  });
  chip.addEventListener("pointermove", (event) => {
    if (!from) return;
    if (!ghost) {
      if (apart(event, from) < 8) return;
      begin();
      ghost = chip.cloneNode(true);
      ghost.classList.add("ghost");
      document.body.append(ghost);
    }
    ghost.style.transform = `translate(${event.clientX + 12}px, ${event.clientY - 56}px)`;
    act.hover(action, target(event));
  });
  const end = (event) => {
    const wasDragged = ghost;
    ghost?.remove();
    chip.setAttribute("draggable", "true");
    from = ghost = null;
    if (!wasDragged) return;
    act.hover(action, null);
    if (event.type === "pointerup" && target(event)) act.add(action, target(event));
  };
  chip.addEventListener("pointerup", end);
  chip.addEventListener("pointercancel", end);
}
