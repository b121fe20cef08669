// The layers of the map: what an app says of its results, with the results that it says it of, and which of them
// lie under the pointer. Pure.

const USUAL_REACH = 3;

/** The number of a result that is of a quantity. @param {Result} result @param {string | null} quantity */
export const numberOf = (result, quantity) =>
  result.values.find((one) => quantity === null || one.quantity === quantity);

/** Where something was done: where it really was, else where it was to be. @param {Result} result @returns {readonly number[] | null} */
export function placeOf({ value, at, target }) {
  if (value !== null && typeof value === "object") return value.position;
  return at ?? target;
}

/** @param {Layer} layer @param {Result[]} results @returns {{ low: number, high: number } | null} */
function rangeOf({ low, high, quantity }, results) {
  let [least, most] = [Infinity, -Infinity];
  for (const result of results) {
    const value = numberOf(result, quantity)?.value;
    if (value === undefined) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  if (least > most && (low === null || high === null)) return null;
  return { low: low ?? least, high: high ?? most };
}

/** @param {Layer} layer @param {Result[]} results @param {string} [id] @returns {ShownLayer} */
function shown(layer, results, id = layer.id) {
  const { kind, title, quantity, reach } = layer;
  const isNumbers = kind === "heat" || kind === "values";
  const unit = layer.unit ?? results.map((one) => numberOf(one, quantity)?.unit).find((one) => one) ?? null;
  return {
    id, kind, title, quantity, unit, reach: reach ?? USUAL_REACH, results,
    range: isNumbers ? rangeOf(layer, results) : null,
  };
}

/** A layer for each quantity that was measured, of one that stands for all of them. @param {Layer} layer @param {Result[]} results */
function quantities(layer, results) {
  /** @type {Map<string, Result[]>} */
  const groups = new Map();
  for (const result of results) {
    for (const { quantity } of result.values) {
      groups.set(quantity, [...groups.get(quantity) ?? [], result]);
    }
  }
  return [...groups].map(([quantity, group]) =>
    shown({ ...layer, quantity }, group, `${layer.id}:${quantity}`));
}

/**
 * The layers of an app with the results that they show, in the app's order.
 * @param {readonly Layer[]} layers @param {readonly Result[]} results
 * @returns {ShownLayer[]}
 */
export function shownLayers(layers, results) {
  /** @type {Map<string, Result[]>} */
  const byLayer = new Map(layers.map(({ id }) => [id, []]));
  for (const result of results) {
    for (const id of result.layers) byLayer.get(id)?.push(result);
  }
  return layers.flatMap((layer) => {
    const all = byLayer.get(layer.id) ?? [];
    const mine = layer.kind === "findings" ? all.filter(({ tags }) => tags.length) : all;
    const isNumbers = layer.kind === "heat" || layer.kind === "values";
    if (!isNumbers || layer.quantity !== null) return [shown(layer, mine)];
    const isRest = layers.some(({ action, id }) => action === layer.action && id !== layer.id);
    return mine.length || isRest ? quantities(layer, mine) : [shown(layer, mine)];
  });
}

/**
 * Which layers are on: what the reader chose, else all but the heat maps after the first that has
 * something to show, as they would cover it.
 * @param {readonly ShownLayer[]} layers @param {Readonly<Record<string, boolean>>} chosen by their ids
 * @returns {Set<string>}
 */
export function layersOn(layers, chosen) {
  const first = layers.find(({ kind, results }) => kind === "heat" && results.length);
  const usual = (/** @type {ShownLayer} */ layer) => layer.kind !== "heat" || layer === first;
  return new Set(layers.filter((layer) => chosen[layer.id] ?? usual(layer)).map(({ id }) => id));
}

const SAME_PLACE = 0.5; // metres: the same place is never hit exactly

/** Findings as pins, each kind at each place once. @param {readonly Result[]} results the oldest first @returns {Pin[]} */
export function pinsOf(results) {
  /** @type {Map<string, Pin>} */
  const pins = new Map();
  for (const result of results) {
    const [x, y] = result.target ?? placeOf(result) ?? [];
    if (x === undefined) continue;
    const place = `${Math.round(x / SAME_PLACE)} ${Math.round(y / SAME_PLACE)}`;
    for (const tag of new Set(result.tags)) {
      const key = `${tag} ${place}`;
      const before = pins.get(key);
      const count = result.tags.filter((one) => one === tag).length;
      pins.set(key, { key, tag, x, y, count, results: [result, ...before?.results ?? []] });
    }
  }
  return [...pins.values()];
}

/** How often each kind was found, by its pins; the most frequent first. @param {readonly Pin[]} pins @returns {{ tag: string, count: number, places: number }[]} */
export function countsOf(pins) {
  /** @type {Map<string, { tag: string, count: number, places: number }>} */
  const counts = new Map();
  for (const { tag, count } of pins) {
    const before = counts.get(tag) ?? { tag, count: 0, places: 0 };
    counts.set(tag, { tag, count: before.count + count, places: before.places + 1 });
  }
  return [...counts.values()].toSorted((a, b) => b.count - a.count || a.tag.localeCompare(b.tag));
}

/** Photos as they lie on the ground, the sharpest last, so that it lies on top. @param {readonly Result[]} results @returns {PhotoOnMap[]} */
export function photosOf(results) {
  return results.flatMap((result) => {
    const { value } = result;
    if (value === null || typeof value !== "object") return [];
    const { position: [x, y], width, height, sharpness, picture, sees } = value;
    return [{ result, x, y, width, height, sharpness, picture, sees }];
  }).toSorted((a, b) => a.sharpness - b.sharpness || a.result.number - b.result.number);
}

export const NEAR = 14; // pixels around what is small

/**
 * The results at a place, the newest first; none: nothing is there.
 * @param {At} at in metres
 * @param {number} scale pixels a metre
 * @param {{ pins: readonly Pin[], values: readonly Spot[], photos: readonly PhotoOnMap[] }} shown
 * @returns {Result[]}
 */
export function hit(at, scale, { pins, values, photos }) {
  let [nearest, found] = [NEAR, /** @type {Result[]} */ ([])];
  for (const { x, y, results } of [...pins, ...values]) {
    const distance = Math.hypot(at.x - x, at.y - y) * scale;
    if (distance < nearest) [nearest, found] = [distance, results];
  }
  if (found.length) return found;
  const photo = photos.findLast(({ x, y, width, height }) =>
    Math.abs(at.x - x) <= width / 2 && Math.abs(at.y - y) <= height / 2);
  return photo ? [photo.result] : [];
}

/** Results of numbers by their places, as the layer draws them. @param {readonly Result[]} results the oldest first @returns {Spot[]} */
export function spotsOf(results) {
  /** @type {Map<string, Spot>} */
  const spots = new Map();
  for (const result of results) {
    const place = placeOf(result);
    if (!place) continue;
    const [x, y] = place;
    const key = `${Math.round(x * 1000)} ${Math.round(y * 1000)}`;
    spots.set(key, { x, y, results: [result, ...spots.get(key)?.results ?? []] });
  }
  return [...spots.values()];
}
