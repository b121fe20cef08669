// The page Map: places and zones get their names here, and a floor plan is laid under the map.

import { signal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { freeName } from "../core/changes.js";
import { DRAWN } from "../core/drawings.js";
import { number, t, typedNumber } from "../core/i18n.js";
import { changeMap, landmarks, onEarth, uploadDrawing, uploadPlan } from "../core/landmarks.js";
import { app, mayFly, tell } from "../core/station.js";
import { World } from "../core/world.js";
import { Camera, Mark } from "../map/camera.js";
import { Homes, Names } from "../map/fleet.js";
import { Floor, MapSplit } from "../map/floor.js";
import { landmarkNames, Landmarks, middle, North } from "../map/ground.js";
import { Gap, useLongList } from "../ui/long_list.js";
import { Button, Empty, IconButton, Input, Said } from "../ui/parts.js";
import { calibrated } from "./calibration.js";
import { isWorldFile, placed, toMap } from "./world_file.js";

/** @typedef {"look" | "place" | "zone" | "scale"} Tool */
const STEP = 0.1; // metres to which what is drawn snaps
const FINE = 0.01; // with Shift

const NO_FLIGHT = new World(); // of the drones only the homes are drawn

/** What a press on the map does, and the points that were pressed so far. */
const tool = signal(/** @type {Tool} */ ("look"));
const points = signal(/** @type {At[]} */ ([]));

/** @param {Tool} next */
function take(next) {
  tool.value = tool.peek() === next ? "look" : next;
  points.value = [];
}

/** @param {At} at @param {boolean} fine @returns {At} */
function snapped({ x, y }, fine) {
  const to = fine ? FINE : STEP;
  const round = (/** @type {number} */ value) => Number((Math.round(value / to) * to).toFixed(2));
  return { x: round(x), y: round(y) };
}

const names = (/** @type {MapData} */ { places, zones }) => [...places, ...zones].map(({ name }) => name);

/** @param {At} at */
const addPlace = (at) => changeMap((map) => ({
  places: [...map.places, { name: freeName(t("map.place"), names(map)), ...at }],
}));

function closeZone() {
  const corners = points.peek().map(({ x, y }) => [x, y]);
  take("zone");
  if (corners.length < 3) return;
  changeMap((map) => ({ zones: [...map.zones, { name: freeName(t("map.zone"), names(map)), corners }] }));
}

export default function MapPage() {
  const shape = /** @type {AppShape} */ (app.value);
  const camera = useMemo(() => new Camera(shape.map.size), [shape]);
  const drawn = landmarks.value;
  const can = mayFly.value && (drawn?.writable ?? false);
  useEffect(() => () => take("look"), []);
  /** @param {At} at @param {PointerEvent} event */
  function press(at, event) {
    const place = tool.value === "scale" ? at : snapped(at, event.shiftKey);
    if (tool.value === "place") addPlace(place);
    if (tool.value === "zone" || tool.value === "scale") points.value = [...points.value, place].slice(tool.value === "scale" ? -2 : 0);
  }
  return h(MapSplit, {
    stage: h(Floor, {
      map: shape.map, camera, onPlace: press, class: tool.value === "look" ? "" : "aiming",
      overlay: [h(Names, { key: "names", world: NO_FLIGHT, chosen: null, more: landmarkNames }), h(North, { key: "north" })],
      children: [h(Landmarks, { key: "landmarks" }), h(Homes, { key: "homes", app: shape }), h(Sketch, { key: "sketch" })],
    }),
    rail: h("div", { class: "rail-body stack" },
      drawn?.said && h("p", { class: drawn.writable ? "hint" : "problem" }, h(Said, { text: drawn.said })),
      can && h(Tools, null),
      drawn ? h(Lists, { drawn, can, onShow: (at) => camera.reveal(at.x, at.y) }) : h(Empty, null, t("loading"))),
  });
}

/** What is being drawn. */
function Sketch() {
  const all = points.value;
  return h("g", { class: "layer sketch" },
    all.length > 1 && h("polyline", { points: all.map(({ x, y }) => `${x},${y}`).join(" ") }),
    all.map(({ x, y }, i) => h(Mark, { key: i, x, y }, h("circle", { r: 5 }))));
}

function Tools() {
  const now = tool.value;
  const count = points.value.length;
  return h("div", { class: "stack" },
    h("div", { class: "row", role: "group", "aria-label": t("map.tools") },
      h(Button, { icon: "pin", pressed: now === "place", onClick: () => take("place") }, t("map.add-place")),
      h(Button, { icon: "map", pressed: now === "zone", onClick: () => take("zone") }, t("map.add-zone"))),
    h("p", { class: "hint", "aria-live": "polite" }, now === "look" ? t("map.look-hint")
      : now === "place" ? t("map.place-hint") : now === "zone" ? t("map.zone-hint", { n: count }) : t("map.scale-hint")),
    now === "place" && h(ByHand, { onDone: addPlace }),
    now === "zone" && h(ByHand, { onDone: (at) => { points.value = [...points.value, at]; } }),
    now === "zone" && h(Button, { kind: "primary", disabled: count < 3, onClick: closeZone }, t("map.zone-close")),
    landmarks.value?.plane && h(DrawingTools, null),
    h(PlanTools, null));
}

/** Places and zones that another program has drawn. */
function DrawingTools() {
  const picked = useRef(/** @type {HTMLInputElement | null} */ (null));
  const upload = async () => {
    const input = /** @type {HTMLInputElement} */ (picked.current);
    const [file] = input.files ?? [];
    if (file) await uploadDrawing(file);
    input.value = ""; // the same file may be taken again
  };
  return h("details", { class: "plan-tools" }, h("summary", null, t("map.drawing")), h("div", { class: "field" },
    h("label", { for: "drawing-file" }, t("map.drawing-file")),
    h("input", { id: "drawing-file", ref: picked, type: "file", accept: DRAWN.join(), onChange: upload })));
}

/** A point by its numbers, for those who do not point. @param {{ onDone: (at: At) => void }} props */
function ByHand({ onDone }) {
  const form = useRef(/** @type {HTMLFormElement | null} */ (null));
  /** @param {SubmitEvent} event */
  function submit(event) {
    event.preventDefault();
    const given = new FormData(/** @type {HTMLFormElement} */ (form.current));
    const [x, y] = ["x", "y"].map((name) => typedNumber(String(given.get(name))));
    if (typeof x === "number" && typeof y === "number") onDone({ x, y });
    form.current?.reset();
  }
  return h("form", { ref: form, class: "row by-hand", onSubmit: submit },
    ["x", "y"].map((name) => h("input", {
      key: name, name, class: "input", inputmode: "decimal", required: true, placeholder: `${name} (m)`, "aria-label": t("map.coordinate", { name }),
    })),
    h(Button, { type: "submit", small: true }, t("map.apply")));
}

/** Where a picture lies by its world file, in degrees where the map lies on the Earth, else in metres of the map. @param {File} file @param {File} beside */
async function lying(file, beside) {
  try {
    return placed(await beside.text(), await createImageBitmap(file), toMap(landmarks.peek()?.plane ?? null));
  } catch {
    return null; // a drawing has no pixels
  }
}

function PlanTools() {
  const picked = useRef(/** @type {HTMLInputElement | null} */ (null));
  const [length, setLength] = useState("");
  const image = landmarks.value?.image ?? null;
  const [first, second] = points.value;
  function scale() {
    const metres = typedNumber(length);
    if (!image || !second || typeof metres !== "number" || metres <= 0) return;
    changeMap(() => ({ image: { ...image, ...calibrated(image, first, second, metres) } }));
    take("scale");
  }
  const upload = async () => {
    const files = [...picked.current?.files ?? []];
    const beside = files.find(({ name }) => isWorldFile(name));
    const file = files.find((one) => one !== beside);
    if (!file) return;
    const place = beside ? await lying(file, beside) : null;
    if (beside && !place) tell(t("map.world-file-wrong"), { bad: true });
    else if (await uploadPlan(file)) {
      if (place) await changeMap((map) => ({ image: map.image && { ...map.image, ...place } }));
      location.reload(); // the picture is fetched once
    }
  };
  return h("details", { class: "plan-tools" }, h("summary", null, t("map.floor-plan")), h("div", { class: "stack" },
    h("div", { class: "field" }, h("label", { for: "plan-file" }, t("map.plan-file")),
      h("input", { id: "plan-file", ref: picked, type: "file", multiple: true, accept: "image/png,image/jpeg,image/webp,image/svg+xml,.pgw,.jgw,.wld,.pngw,.jpgw", onChange: upload })),
    image && h(Button, { pressed: tool.value === "scale", onClick: () => take("scale") }, t("map.calibrate")),
    image && tool.value === "scale" && h("form", {
      class: "row", onSubmit: (/** @type {SubmitEvent} */ event) => {
        event.preventDefault();
        scale();
      },
    },
    h(Input, { inputmode: "decimal", "aria-label": t("map.length"), placeholder: t("map.length"), value: length, onText: setLength }),
    h(Button, { type: "submit", small: true, disabled: points.value.length < 2 }, t("map.apply"))),
    h(Northern, null)));
}

function Northern() {
  const north = landmarks.value?.north ?? 0;
  return h("div", { class: "field" }, h("label", { for: "north" }, t("map.north-field")),
    h("input", {
      id: "north", inputmode: "decimal", value: String(north),
      onChange: (/** @type {Event} */ event) => {
        const value = typedNumber(/** @type {HTMLInputElement} */ (event.target).value);
        if (typeof value === "number") changeMap(() => ({ north: value }));
      },
    }));
}

/** @param {{ drawn: MapData, can: boolean, onShow: (at: At) => void }} props */
function Lists({ drawn: { places, zones }, can, onShow }) {
  return h("div", { class: "stack" },
    h("h2", null, t("map.places")),
    places.length ? h(Places, { places, can, onShow }) : h(Empty, null, t("map.no-places")),
    h("h2", null, t("map.zones")),
    zones.length ? h("ul", { class: "landmark-list" }, zones.map((zone, at) => h(Item, {
      key: at, at, count: zones.length, can, name: zone.name, said: t("map.corners", { n: zone.corners.length }),
      onShow: () => onShow(middle(zone.corners)),
      onName: (name) => changeMap((map) => ({ zones: map.zones.with(at, { ...map.zones[at], name }) })),
      onRemove: () => changeMap((map) => ({ zones: map.zones.toSpliced(at, 1) })),
    }))) : h(Empty, null, t("map.no-zones")));
}

const HEIGHT = 48; // pixels of a place in the list

/** @param {{ places: Place[], can: boolean, onShow: (at: At) => void }} props */
function Places({ places, can, onShow }) {
  const list = useRef(/** @type {HTMLUListElement | null} */ (null));
  const parts = useLongList(list, places.length);
  return h("ul", { ref: list, class: "landmark-list" }, parts.map(({ at, gap }) => {
    if (gap) return h(Gap, { key: `gap ${at}`, at, gap, height: HEIGHT });
    const place = places[at];
    return h(Item, {
      key: at, at, count: places.length, can, name: place.name,
      said: [t("map.at", { x: number(place.x), y: number(place.y) }), onEarth([place.x, place.y])].filter(Boolean).join(" · "),
      onShow: () => onShow(place),
      onName: (name) => changeMap((map) => ({ places: map.places.with(at, { ...map.places[at], name }) })),
      onRemove: () => changeMap((map) => ({ places: map.places.toSpliced(at, 1) })),
    });
  }));
}

/** @param {{ at: number, count: number, name: string, said: string, can: boolean, onShow: () => void, onName: (name: string) => void, onRemove: () => void }} props at: its place among so many */
const Item = ({ at, count, name, said, can, onShow, onName, onRemove }) => h("li", { class: "row", "data-at": at, "aria-posinset": at + 1, "aria-setsize": count },
  can ? h("input", {
    class: "input", "aria-label": t("map.name-of", { name }), value: name, maxlength: 80,
    onChange: (/** @type {Event} */ event) => onName(/** @type {HTMLInputElement} */ (event.target).value.trim()),
  }) : h("span", { class: "called" }, name),
  h("button", { type: "button", class: "link num", onClick: onShow }, said),
  can && h(IconButton, { icon: "close", label: t("map.remove", { name }), onClick: onRemove }));
