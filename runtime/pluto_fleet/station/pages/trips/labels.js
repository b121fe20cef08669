// Names beside pins and places, which avoid each other.

import { h } from "preact";
import { capital } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { useCamera } from "../map/camera.js";
import { landmarkNames } from "../map/landmarks.js";
import { LINE, placed } from "../map/labels.js";
import { toPixels, whyNot } from "../map/view.js";
import { where } from "./commands.js";
import { BESIDE } from "./pins.js";
import { abouts, hovered, marked, places } from "./state.js";

/** @import { Label } from "../map/labels.js" */
/** @import { About } from "./state.js" */

const MOST = 40; // letters

/** @param {string} text */
const short = (text) => (text.length > MOST ? `${text.slice(0, MOST - 1)}…` : text);

/** @param {About} about */
function words({ trip, target, isHeld, place, problems }) {
  if (!isHeld) return [capital(trip.action), ...(trip.name ? [trip.name] : [])].join(" · ");
  return problems.find(({ field }) => field === "target")?.text || place || t("trips.metres", { place: where(target ?? []) });
}

/** Where the action in hand would go now. @returns {(Omit<Label, "x" | "y"> & { target: readonly number[], aside: number })[]} */
function inTheAir() {
  const target = hovered.value;
  if (!target || !app.value) return [];
  const wrong = whyNot(app.value.map, target);
  const name = places.value.find(({ x, y }) => x === target[0] && y === target[1])?.name;
  const text = wrong ? t(wrong) : name ?? t("trips.metres", { place: where(target) });
  return [{ key: "new", text: short(text), target, importance: 5, always: true, gap: 18, aside: 0, kind: wrong ? "bad" : "" }];
}

export function TripLabels() {
  const camera = useCamera();
  const [view, box] = [camera.view.value, camera.box.value];
  const chosen = new Set(marked.value);
  const pins = abouts.value.flatMap((about) => {
    const { key, target, isHeld, problems, beside } = about;
    if (!target) return [];
    const isOne = isHeld || (chosen.has(key) && chosen.size === 1);
    return [{
      key, target, text: short(words(about)), gap: 18, aside: beside * BESIDE, always: isOne, kind: isHeld && problems.length ? "bad" : "",
      importance: isOne ? 4 : problems.length ? 3 : 2,
    }];
  });
  const named = landmarkNames.value.map(({ x, y, ...label }) => ({ ...label, target: [x, y], aside: 0 }));
  const labels = [...inTheAir(), ...pins, ...named].map(({ target, aside, ...label }) => {
    const { x, y } = toPixels(view, target[0], target[1]);
    return { ...label, x: x + aside, y };
  });
  const marks = labels.filter(({ key }) => abouts.value.some((about) => about.key === key)).map(({ x, y }) => ({ x, y, r: 13 }));
  return h("div", { class: "names", "aria-hidden": true }, placed(labels, box, marks).map(({ key, text, left, top, width, kind }) =>
    h("span", {
      key, class: `name ${kind ?? ""}`,
      style: { transform: `translate(${left}px, ${top}px)`, width: `${width}px`, height: `${LINE}px` },
    }, text)));
}
