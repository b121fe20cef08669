// The ways from home through the trips, and the trips of other missions, faintly.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { app, plan, selected, selection } from "../core/station.js";
import { Mark } from "../map/camera.js";
import { called } from "../missions/words.js";
import { abouts } from "./state.js";

/** @import { Point } from "../app" */

/** The home that is nearest to a place. @param {readonly { home: Point }[]} drones @param {Point} to */
function nearest(drones, [x, y]) {
  const far = (/** @type {{ home: Point }} */ { home }) => Math.hypot(home[0] - x, home[1] - y);
  return drones.toSorted((a, b) => far(a) - far(b))[0]?.home;
}

export function Ways() {
  const points = abouts.value.flatMap(({ target }) => (target ? [target.slice(0, 2)] : []));
  const home = points.length ? nearest(app.value?.drones ?? [], points[0]) : undefined;
  return h("g", { class: "layer ways" },
    home && h("polyline", { class: "from-home", points: `${home.slice(0, 2)} ${points[0]}` }),
    h("polyline", { points: points.join(" ") }));
}

/** @param {{ shown: boolean }} props of all other missions, also while one is selected */
export function OtherTrips({ shown }) {
  if (!shown && selected.value) return null;
  const others = plan.missions.value.filter(({ key }) => key !== selection.value.key);
  return h("g", { class: "layer other-trips" }, others.flatMap((mission) => mission.trips.map((trip, at) =>
    trip.target && h(Mark, { key: trip.key, x: trip.target[0], y: trip.target[1] }, h("circle", { r: 5 },
      h("title", null, t("trips.other", { mission: called(mission), trip: trip.name ?? String(at + 1) })))))));
}
