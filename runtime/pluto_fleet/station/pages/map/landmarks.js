// The named places and zones on the map, and where north is.

import { computed } from "@preact/signals";
import { h } from "preact";
import { t } from "../core/i18n.js";
import { landmarks } from "../core/landmarks.js";
import { Mark } from "./camera.js";

/** @import { Label } from "./labels.js" */

/** The middle of a polygon's corners, where its name stands. @param {readonly (readonly number[])[]} corners */
export const middle = (corners) => ({
  x: corners.reduce((sum, [x]) => sum + x, 0) / corners.length,
  y: corners.reduce((sum, [, y]) => sum + y, 0) / corners.length,
});

/** Their names, in metres, to be laid out with others. */
export const landmarkNames = computed(() => {
  const { places = [], zones = [] } = landmarks.value ?? {};
  /** @type {Label[]} */
  const labels = [
    ...places.map(({ name, x, y }) => ({ key: `place ${name}`, text: name, x, y, importance: 0, gap: 8, kind: "place" })),
    ...zones.map(({ name, corners }) => ({ key: `zone ${name}`, text: name, ...middle(corners), importance: -1, gap: 0, kind: "zone" })),
  ];
  return labels;
});

export function Landmarks() {
  const { places = [], zones = [] } = landmarks.value ?? {};
  return h("g", { class: "layer landmarks" },
    zones.map(({ name, corners }) => h("polygon", { key: name, class: "zone", points: corners.join(" ") }, h("title", null, name))),
    places.map(({ name, x, y }) => h(Mark, { key: name, x, y },
      h("circle", { class: "place", r: 4 }, h("title", null, name)))));
}

export function North() {
  const north = landmarks.value?.north ?? 0;
  if (!north) return null; // it is up, as on most maps
  return h("svg", { class: "north", viewBox: "-16 -16 32 32", width: 32, height: 32, role: "img", "aria-label": t("map.north-at", { degrees: north }) },
    h("g", { transform: `rotate(${north})` }, h("path", { d: "M0 -13L5 6L0 3L-5 6Z" }), h("text", { y: 14 }, "N")));
}
