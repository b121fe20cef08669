// Which part of the map is seen: where (0, 0) lies in pixels, and how many pixels a metre has. Pure.

/** @typedef {readonly number[]} Size along x and y, in metres */
/** @typedef {{ x: number, y: number }} At */

const CLOSEST = 800; // pixels a metre: one centimetre is easy to hit
const MARGIN = { left: 34, right: 22, top: 22, bottom: 64 }; // pixels, for rulers and the foot

/** @param {number} value @param {number} low @param {number} high */
export const between = (value, low, high) => Math.min(Math.max(value, low), high);

/** The scale at which the whole map is seen. @param {Box} box @param {Size} size */
export const fitting = (box, [width, height]) => Math.max(0.01, Math.min(
  (box.width - MARGIN.left - MARGIN.right) / width, (box.height - MARGIN.top - MARGIN.bottom) / height));

/** The whole map, in the middle. @param {Box} box @param {Size} size @returns {View} */
export function whole(box, size) {
  const scale = fitting(box, size);
  return {
    scale,
    left: (box.width + MARGIN.left - MARGIN.right - size[0] * scale) / 2,
    bottom: (box.height + MARGIN.top - MARGIN.bottom + size[1] * scale) / 2,
  };
}

/** A view of which the middle is on the map, so that the map cannot get lost. @param {View} view @param {Box} box @param {Size} size @returns {View} */
export function kept({ left, bottom, scale }, box, [width, height]) {
  const [x, y] = [box.width / 2, box.height / 2];
  return {
    scale,
    left: between(left, x - width * scale, x),
    bottom: between(bottom, y, y + height * scale),
  };
}

/** @param {View} view @param {number} factor @param {At} at the pixel that stays where it is @param {Box} box @param {Size} size */
export function zoomed(view, factor, at, box, size) {
  const least = fitting(box, size);
  const scale = between(view.scale * factor, least * 0.7, Math.max(CLOSEST, least));
  const by = scale / view.scale;
  return kept({
    scale, left: at.x - (at.x - view.left) * by, bottom: at.y - (at.y - view.bottom) * by,
  }, box, size);
}

/** @param {View} view @param {At} pixel @returns {At} in metres */
export const toMetres = ({ left, bottom, scale }, { x, y }) =>
  ({ x: (x - left) / scale, y: (bottom - y) / scale });

/** @param {View} view @param {number} x @param {number} y @returns {At} in pixels */
export const toPixels = ({ left, bottom, scale }, x, y) =>
  ({ x: left + x * scale, y: bottom - y * scale });

/** The least of 1, 2, 5, 10, … metres that takes so many pixels. @param {number} scale @param {number} pixels */
export function step(scale, pixels) {
  const power = 10 ** Math.floor(Math.log10(pixels / scale));
  const factor = [1, 2, 5, 10].find((one) => one * power * scale > pixels - 0.01) ?? 10;
  return Number((power * factor).toPrecision(3));
}

/** Where lines are, in metres: at least `apart` pixels apart, seen between two pixels, up to a length. @param {number} scale @param {number} apart @param {number} from @param {number} to @param {number} length */
export function lines(scale, apart, from, to, length) {
  const every = step(scale, apart);
  const last = Math.min(to / scale, length) / every + 1e-6;
  /** @type {number[]} */
  const found = [];
  for (let n = Math.max(0, Math.ceil(from / scale / every)); n <= last; n += 1) {
    found.push(Number((n * every).toFixed(3)));
  }
  return found;
}

/** Why nothing can be flown to a place, at a first look; the station has the last word. @param {{ size: Size, no_fly: number[][][] }} map @param {readonly number[]} place @returns {"" | "map.outside" | "map.in-no-fly"} */
export function whyNot({ size: [width, height], no_fly: areas }, [x, y]) {
  if (x < 0 || y < 0 || x > width || y > height) return "map.outside";
  return areas.some((area) => isInside(x, y, area)) ? "map.in-no-fly" : "";
}

/** @param {number} x @param {number} y @param {readonly (readonly number[])[]} corners */
function isInside(x, y, corners) {
  let within = false;
  corners.forEach(([ax, ay], at) => {
    const [bx, by] = /** @type {readonly number[]} */ (corners.at(at - 1));
    if ((ay > y) !== (by > y) && x < ax + ((y - ay) * (bx - ax)) / (by - ay)) within = !within;
  });
  return within;
}

export const MOST_MARKS = 250;
const AROUND = 60; // pixels around the map's box in which marks are there already, as it will be moved

/**
 * Which of many places have a mark of their own.
 * @template Thing
 * @param {readonly Thing[]} all @param {(one: Thing) => readonly number[]} at where one is, in metres
 * @param {View} view @param {Box} box @returns {readonly Thing[]}
 */
export function marksOf(all, at, view, box) {
  if (all.length <= MOST_MARKS) return all;
  const near = all.filter((one) => {
    const { x, y } = toPixels(view, at(one)[0], at(one)[1]);
    return x > -AROUND && y > -AROUND && x < box.width + AROUND && y < box.height + AROUND;
  });
  return near.length <= MOST_MARKS ? near : [];
}

/** The one of many places that is nearest to a pressed one, if it is so near that it was meant. @template Thing @param {readonly Thing[]} all @param {(one: Thing) => readonly number[]} at @param {At} pressed @param {number} metres */
export function nearest(all, at, { x, y }, metres) {
  const far = (/** @type {Thing} */ one) => Math.hypot(at(one)[0] - x, at(one)[1] - y);
  let [found, least] = [/** @type {Thing | null} */ (null), metres];
  for (const one of all) {
    if (far(one) <= least) [found, least] = [one, far(one)];
  }
  return found;
}
