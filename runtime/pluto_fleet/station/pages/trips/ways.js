// The ways from home through the trips, and the trips of other missions, faintly.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { app, plan, selected, selection } from "../core/station.js";
import { Mark } from "../map/camera.js";
import { way } from "../map/routes.js";
import { called } from "../missions/words.js";
import { abouts } from "./state.js";

/** The home that is nearest to a place. @param {readonly { home: Point }[]} drones @param {Point} to */
function nearest(drones, [x, y]) {
  const far = (/** @type {{ home: Point }} */ { home }) => Math.hypot(home[0] - x, home[1] - y);
  return drones.toSorted((a, b) => far(a) - far(b))[0]?.home;
}

export function Ways() {
  const placed = abouts.value.flatMap(({ target, isHeld }) => (target ? [{ target, isHeld }] : []));
  const home = placed.length ? nearest(app.value?.drones ?? [], placed[0].target) : undefined;
  const legs = [...(home ? [{ target: home.slice(0, 2), isHeld: false }] : []), ...placed];
  return h("g", { class: "layer ways" }, legs.slice(1).map(({ target, isHeld }, at) => {
    const from = legs[at];
    const found = isHeld || from.isHeld ? undefined : way([from.target, target]);
    const points = (found ?? [from.target, target]).map(([x, y]) => `${x},${y}`).join(" ");
    const kind = found === null ? "no-way" : home && at === 0 ? "from-home" : "";
    return h("polyline", { key: at, class: kind, points }, found === null && h("title", null, t("trips.no-way")));
  }));
}

/** @param {{ shown: boolean }} props of all other missions, also while one is selected */
export function OtherTrips({ shown }) {
  if (!shown && selected.value) return null;
  const others = plan.missions.value.filter(({ key }) => key !== selection.value.key);
  return h("g", { class: "layer other-trips" }, others.flatMap((mission) => mission.trips.map((trip, at) =>
    trip.target && h(Mark, { key: trip.key, x: trip.target[0], y: trip.target[1] }, h("circle", { r: 5 },
      h("title", null, t("trips.other", { mission: called(mission), trip: trip.name ?? String(at + 1) })))))));
}
