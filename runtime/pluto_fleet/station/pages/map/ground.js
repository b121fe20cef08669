// What lies still on the map: paper, floor plan, grid, areas closed to drones, named places and zones, rulers, scale
// and north.

import { effect, signal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { fetchFile, token } from "../core/api.js";
import { t } from "../core/i18n.js";
import { landmarks } from "../core/landmarks.js";
import { Mark, useCamera } from "./camera.js";
import { Dots, useMarks } from "./many.js";
import { lines, marksOf, MOST_MARKS, step } from "./view.js";

/** @type {Map<string, Signal<string | null>>} by the picture's address */
const pictures = new Map();

/** The address of a picture that the station serves; null until it is here. @param {string | null} address */
export function pictureAt(address) {
  if (address === null || !token.value) return address;
  let found = pictures.get(address);
  if (!found) { // an image element sends no token
    const fetched = signal(/** @type {string | null} */ (null));
    pictures.set(address, found = fetched);
    fetchFile(address).then((file) => { fetched.value = URL.createObjectURL(file); }, () => null);
  }
  return found.value;
}

/** In the dark a picture that is mostly white, as drawings are, is turned over. @param {HTMLImageElement} picture */
function isPaper(picture) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 8, height: 8 });
  const brush = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  brush.fillStyle = "white";
  brush.fillRect(0, 0, 8, 8);
  brush.drawImage(picture, 0, 0, 8, 8);
  try {
    return brush.getImageData(0, 0, 8, 8).data.reduce((sum, one) => sum + one) > 200 * 256;
  } catch {
    return false; // some browsers do not let drawings be looked at
  }
}

/** @param {{ map: MapShape }} props */
export function Ground({ map }) {
  const [width, height] = map.size;
  const id = useId();
  const image = useRef(/** @type {SVGImageElement | null} */ (null));
  const laid = landmarks.value?.image;
  const address = pictureAt(laid?.address ?? map.image);
  const place = laid ?? { x: 0, y: 0, width, height, turn: 0 };
  useEffect(() => {
    if (!address) return;
    const probe = new Image();
    probe.onload = () => image.current?.classList.toggle("paper-like", isPaper(probe));
    probe.src = address;
  }, [address]);
  return h("g", { class: map.image ? "ground pictured" : "ground" },
    h(Hatch, { id }),
    h("rect", { class: "paper", width, height }),
    address && h("image", {
      ref: image, class: "picture", width: place.width, height: place.height, href: address,
      preserveAspectRatio: "none",
      transform: `translate(${place.x} ${place.y}) rotate(${-place.turn}) translate(0 ${place.height}) scale(1 -1)`,
    }),
    h(Grid, { map }),
    map.no_fly.map((corners, at) => h("polygon", {
      key: at, class: "no-fly", points: corners.join(" "), fill: `url(#${id})`,
    }, h("title", null, t("map.no-fly", { n: at + 1 })))),
    h("rect", { class: "rim", width, height }));
}

/** @param {{ id: string }} props */
function Hatch({ id }) {
  const pattern = useRef(/** @type {SVGPatternElement | null} */ (null));
  const camera = useCamera();
  useEffect(() => effect(() => {
    pattern.current?.setAttribute("patternTransform", `scale(${1 / camera.view.value.scale})`);
  }), [camera]);
  return h("defs", null, h("pattern", {
    ref: pattern, id, class: "hatch", patternUnits: "userSpaceOnUse", width: 10, height: 10,
  }, h("rect", { width: 10, height: 10 }), h("path", { d: "M-2 12L12 -2M-2 2L2 -2M8 12L12 8" })));
}

/** @param {{ map: MapShape }} props */
function Grid({ map: { size: [width, height] } }) {
  const path = useRef(/** @type {SVGPathElement | null} */ (null));
  const camera = useCamera();
  useEffect(() => effect(() => {
    const [{ scale, left, bottom }, box] = [camera.view.value, camera.box.value];
    const across = lines(scale, 28, -left, box.width - left, width);
    const upwards = lines(scale, 28, bottom - box.height, bottom, height);
    path.current?.setAttribute("d", across.map((x) => `M${x} 0V${height}`).join("")
      + upwards.map((y) => `M0 ${y}H${width}`).join(""));
  }), [camera, width, height]);
  return h("path", { ref: path, class: "grid" });
}

const KILOMETRE = 1000; // metres

/** @param {{ map: MapShape }} props */
export function Rulers({ map: { size: [width, height] } }) {
  const camera = useCamera();
  const [{ scale, left, bottom }, box] = [camera.view.value, camera.box.value];
  const upwards = lines(scale, 44, bottom - box.height + 24, bottom - 12, height);
  const across = lines(scale, 56, 24 - left, box.width - 8 - left, width);
  const wide = 7.5 * Math.max(0, ...upwards.map((metres) => String(metres).length)) + 12;
  const x = Math.min(Math.max(left, wide), box.width - 4);
  const y = Math.min(Math.max(bottom, 20), box.height - 20);
  const written = (/** @type {number} */ metres) => (step(scale, 44) < KILOMETRE ? metres : `${metres / KILOMETRE} km`);
  return h("g", { class: "rulers", "aria-hidden": true },
    across.map((metres) => h("g", {
      key: `x${metres}`, transform: `translate(${left + metres * scale} ${y})`,
    }, h("path", { d: "M0 0v5" }), h("text", { y: 17 }, written(metres)))),
    upwards.map((metres) => h("g", {
      key: `y${metres}`, transform: `translate(${x} ${bottom - metres * scale})`,
    }, h("path", { d: "M0 0h-5" }), h("text", { x: -8, y: 4, class: "left" }, written(metres)))));
}

export function ScaleBar() {
  const { scale } = useCamera().view.value;
  const metres = step(scale, 56);
  return h("svg", {
    class: "scale-bar", height: 20, width: Math.ceil(metres * scale) + 4, role: "img",
    "aria-label": t("map.scale", { n: metres }),
  }, h("path", { d: `M1 12v5h${metres * scale}v-5` }),
  h("text", { x: 1 + (metres * scale) / 2, y: 9 }, metres < KILOMETRE ? `${metres} m` : `${metres / KILOMETRE} km`));
}

/** The middle of a polygon's corners, where its name stands. @param {readonly (readonly number[])[]} corners */
export const middle = (corners) => ({
  x: corners.reduce((sum, [x]) => sum + x, 0) / corners.length,
  y: corners.reduce((sum, [, y]) => sum + y, 0) / corners.length,
});

/** @param {Place} place */
const placeOf = ({ x, y }) => [x, y];

/** Their names, in metres, to be laid out with others; dots have none. @param {View} view @param {Box} box @returns {Label[]} */
export function landmarkNames(view, box) {
  const { places = [], zones = [] } = landmarks.value ?? {};
  return [
    ...marksOf(places, placeOf, view, box).map(({ name, x, y }) => ({ key: `place ${name}`, text: name, x, y, importance: 0, gap: 8, kind: "place" })),
    ...zones.map(({ name, corners }) => ({ key: `zone ${name}`, text: name, ...middle(corners), importance: -1, gap: 0, kind: "zone" })),
  ];
}

export function Landmarks() {
  const { places = [], zones = [] } = landmarks.value ?? {};
  const marks = useMarks(places, placeOf);
  return h("g", { class: "layer landmarks" },
    zones.map(({ name, corners }) => h("polygon", { key: name, class: "zone", points: corners.join(" ") }, h("title", null, name))),
    places.length > MOST_MARKS && h(Dots, { places: places.map(placeOf) }),
    marks.map(({ name, x, y }) => h(Mark, { key: name, x, y },
      h("circle", { class: "place", r: 4 }, h("title", null, name)))));
}

export function North() {
  const north = landmarks.value?.north ?? 0;
  if (!north) return null; // it is up, as on most maps
  return h("svg", { class: "north", viewBox: "-16 -16 32 32", width: 32, height: 32, role: "img", "aria-label": t("map.north-at", { degrees: north }) },
    h("g", { transform: `rotate(${north})` }, h("path", { d: "M0 -13L5 6L0 3L-5 6Z" }), h("text", { y: 14 }, "N")));
}
