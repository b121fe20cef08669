// The ground of a floor plan: the picture or a plain grid, no-fly areas, the homes of the drones.
// All in metres; what it returns redraws what depends on the scale.

import { svg } from "./dom.js";
import { step, toMetres } from "./floor_view.js";
import { mapPicture } from "./map_picture.js";

let made = 0; // two floor plans may be in one page: the patterns need names of their own

export function ground(map, drones) {
  const [width, height] = map.size;
  const hatch = svg("pattern", {
    id: `no-fly-${made += 1}`, class: "hatch", patternUnits: "userSpaceOnUse", width: 10, height: 10,
  },
  svg("rect", { width: 10, height: 10 }),
  svg("path", { d: "M-2 12 L12 -2 M-2 2 L2 -2 M8 12 L12 8" }));
  const grid = svg("path", { class: "grid" });
  const picture = map.image ? [image(map)] : [];
  const element = svg("g", { class: map.image ? "ground pictured" : "ground" },
    svg("defs", {}, hatch),
    svg("rect", { class: "paper", width, height }),
    ...picture,
    grid,
    ...map.no_fly.map((corners, index) => svg("polygon", {
      class: "no-fly",
      points: corners.map(([x, y]) => `${x},${y}`).join(" "),
      fill: `url(#${hatch.id})`,
    }, svg("title", {}, `No-fly area ${index + 1}`))),
    svg("rect", { class: "rim", width, height }));
  return {
    element,
    homes: drones.map((drone) => home(drone)),
    redraw(view, box) {
      hatch.setAttribute("patternTransform", `scale(${1 / view.scale})`);
      grid.setAttribute("d", lines(map.size, view, box));
    },
  };
}

/** The picture lies on the whole map, whatever its own proportions: the fleet file's size counts. */
function image(map) {
  const [width, height] = map.size;
  const element = svg("image", {
    width, height, preserveAspectRatio: "none", class: "picture",
    transform: `translate(0 ${height}) scale(1 -1)`,
  });
  mapPicture(map).then((address) => {
    if (!address) return;
    element.setAttribute("href", address);
    const probe = new Image();
    probe.addEventListener("load", () => {
      if (isPaper(probe)) element.classList.add("paper-like");
    });
    probe.src = address;
  });
  return element;
}

/** Whether a picture is mostly white, as a drawing is: in the dark such a one is turned over. */
function isPaper(picture) {
  const canvas = document.createElement("canvas");
  canvas.width = 32;
  canvas.height = 32;
  const brush = canvas.getContext("2d");
  brush.fillStyle = "white";
  brush.fillRect(0, 0, 32, 32);
  try {
    brush.drawImage(picture, 0, 0, 32, 32);
    const { data } = brush.getImageData(0, 0, 32, 32);
    let bright = 0;
    for (let at = 0; at < data.length; at += 4) {
      if (data[at] + data[at + 1] + data[at + 2] > 3 * 190) bright += 1;
    }
    return bright > 0.6 * 32 * 32;
  } catch {
    return false; // some browsers do not let drawings be looked at: then it stays as it is
  }
}

/** The lines of the grid that are seen. */
function lines([width, height], view, box) {
  const every = step(view.scale, 28);
  const low = toMetres(view, { x: 0, y: box.height });
  const high = toMetres(view, { x: box.width, y: 0 });
  const seen = (from, to, most, line) => {
    const parts = [];
    const first = Math.max(1, Math.ceil(from / every));
    for (let n = first; n * every < Math.min(to, most) - 1e-6; n += 1) {
      parts.push(line((n * every).toFixed(3)));
    }
    return parts.join("");
  };
  return seen(low.x, high.x, width, (x) => `M${x} 0V${height}`)
    + seen(low.y, high.y, height, (y) => `M0 ${y}H${width}`);
}

/** A drone's home, in pixels around (0, 0). */
function home(drone) {
  const name = svg("text", { class: "name", y: 20 }, drone.id);
  return { drone, parts: [
    svg("title", {}, `Home of ${drone.id}`),
    svg("path", { d: "M-6 6 V-1 L0 -7 L6 -1 V6 Z" }),
    name,
  ] };
}
