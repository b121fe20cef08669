// What lies under everything on a floor plan: the picture or a plain grid, no-fly areas, rulers at
// the edges, and the bar that says how long some metres are. Redrawn for what is seen of it.

import { token } from "./api.js";
import { set, svg } from "./dom.js";

let made = 0; // two floor plans may be in one page: the patterns need names of their own
let fetched = null;

// The address of the map's picture, or null. Where the station has a token, the picture needs it.
export function mapPicture({ image }) {
  fetched ??= !image || !token() ? Promise.resolve(image)
    : fetch(image, { headers: { Authorization: `Bearer ${token()}` } })
      .then((answer) => answer.blob()).then(URL.createObjectURL).catch(() => null);
  return fetched;
}

export function ground(map, drones) {
  const [width, height] = map.size;
  const hatch = svg("pattern", {
    id: `no-fly-${made += 1}`, class: "hatch", patternUnits: "userSpaceOnUse", width: 10, height: 10,
  }, svg("rect", { width: 10, height: 10 }), svg("path", { d: "M-2 12L12 -2M-2 2L2 -2M8 12L12 8" }));
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
      element.parentNode.classList.toggle("roomy", isRoomy(drones, scale));
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

// Whether the homes are far enough from each other for their names to be written below them.
function isRoomy(drones, scale) {
  const wide = 7 * Math.max(0, ...drones.map(({ id }) => id.length)) + 6;
  return drones.every(({ home: [x, y] }, at) => drones.slice(at + 1).every(({ home }) =>
    Math.abs(home[0] - x) * scale > wide || Math.abs(home[1] - y) * scale > 27));
}

// The least of 1, 2, 5, 10, 20, … (and 0.5, 0.2, …) metres that takes so many pixels.
function step(scale, pixels) {
  const power = 10 ** Math.floor(Math.log10(pixels / scale));
  return Number((power * [1, 2, 5, 10].find((one) => one * power * scale > pixels - 0.01)).toPrecision(3));
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

export function rulers([width, height]) {
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

export function scaleBar() {
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
      set(element, "aria-label", `This long are ${metres} metres`);
    },
  };
}
