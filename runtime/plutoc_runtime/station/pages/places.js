// Where a drone may be sent, as far as the page can tell at once; the station's word counts.

import { number } from "./numbers.js";

const NEAR = 1e-6; // metres: on the very edge of an area is not in it

/** Why nothing may be done at this place ([x, y] or [x, y, z]), in words; "" where all is well. */
export function whyNot(map, target) {
  const [x, y, z = map.cruise_height] = target;
  const [width, height] = map.size;
  if (x < -NEAR || y < -NEAR || x > width + NEAR || y > height + NEAR) {
    return `Outside the map: x goes from 0 to ${number(width)} m, y from 0 to ${number(height)} m.`;
  }
  if (z < 0) return "Below the ground.";
  if (z > map.ceiling + NEAR) return `Above the ceiling of ${number(map.ceiling)} m.`;
  const area = map.no_fly.findIndex((corners) => isInside([x, y], corners));
  if (area < 0) return "";
  return map.no_fly.length > 1 ? `In no-fly area ${area + 1}.` : "In the no-fly area.";
}

export function isInside([x, y], corners) {
  let within = false;
  for (let at = 0; at < corners.length; at += 1) {
    const [ax, ay] = corners[at];
    const [bx, by] = corners[(at + 1) % corners.length];
    if (distance([x, y], [ax, ay], [bx, by]) <= NEAR) return false;
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) * (bx - ax)) / (by - ay)) within = !within;
  }
  return within;
}

function distance([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const along = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return Math.hypot(x - ax - along * dx, y - ay - along * dy);
}

/** The home that is nearest to a place, or null. */
export function nearestHome(drones, [x, y]) {
  let best = null;
  for (const { home } of drones) {
    const far = Math.hypot(home[0] - x, home[1] - y);
    if (!best || far < best.far) best = { home, far };
  }
  return best && best.home;
}
