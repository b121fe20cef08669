// What differs between two states of a plan, so that it can be taken back later, though others have
// drawn meanwhile: only what is still as it was left is reverted. Pure.

/**
 * A difference: of a value, of the fields of a thing, or of a list of things that have keys.
 * @typedef {{ kind: "value", from: unknown, to: unknown }
 *   | { kind: "fields", fields: Record<string, Difference> }
 *   | KeyedDifference} Difference
 */
/**
 * @typedef {object} KeyedDifference
 * @property {"list"} kind
 * @property {{ item: Keyed, before: string[] }[]} removed with the keys that stood before each
 * @property {Keyed[]} added
 * @property {Record<string, Difference>} changed by key
 * @property {{ from: string[], to: string[] } | null} order of what both lists have
 */
/** @typedef {{ key: string, [field: string]: unknown }} Keyed */

const STATIONS_OWN = ["launched", "ended"]; // pages do not set them

/** @param {unknown} value @returns {value is Record<string, unknown>} */
const isThing = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** @param {unknown} value @returns {value is Keyed[]} */
const isKeyed = (value) => Array.isArray(value) && value.every((one) => isThing(one) && typeof one.key === "string");

/** @param {unknown} value @returns {unknown} the same with its fields in order, so that its text is one */
const inOrder = (value) => {
  if (Array.isArray(value)) return value.map(inOrder);
  if (!isThing(value)) return value;
  const names = Object.keys(value).filter((name) => value[name] !== undefined && !STATIONS_OWN.includes(name)).sort();
  return Object.fromEntries(names.map((name) => [name, inOrder(value[name])]));
};

/** @param {unknown} one @param {unknown} other */
export const isSame = (one, other) => JSON.stringify(inOrder(one)) === JSON.stringify(inOrder(other));

/** @param {Keyed[]} items */
const keysOf = (items) => items.map(({ key }) => key);

/** @param {Keyed[]} before @param {Keyed[]} after @returns {KeyedDifference} */
function ofLists(before, after) {
  const [was, is] = [new Map(before.map((one) => [one.key, one])), new Map(after.map((one) => [one.key, one]))];
  /** @type {Record<string, Difference>} */
  const changed = {};
  for (const [key, item] of is) {
    const found = was.has(key) ? between(was.get(key), item) : null;
    if (found) changed[key] = found;
  }
  const order = {
    from: keysOf(before).filter((key) => is.has(key)), to: keysOf(after).filter((key) => was.has(key)),
  };
  return {
    kind: "list", changed,
    removed: before.flatMap((item, at) => (is.has(item.key) ? [] : [{ item, before: keysOf(before.slice(0, at)) }])),
    added: after.filter(({ key }) => !was.has(key)),
    order: isSame(order.from, order.to) ? null : order,
  };
}

/** What differs; null: nothing. @param {unknown} before @param {unknown} after @returns {Difference | null} */
export function between(before, after) {
  if (isSame(before, after)) return null;
  if (isKeyed(before) && isKeyed(after) && before.length + after.length) return ofLists(before, after);
  const both = [before, after];
  // the numbers of a place are set one by one
  const isPlace = both.every((one) => Array.isArray(one)) && /** @type {any} */ (before).length === /** @type {any} */ (after).length;
  if (!isPlace && !both.every(isThing)) return { kind: "value", from: before, to: after };
  const [old, fresh] = /** @type {Record<string, unknown>[]} */ (both);
  /** @type {Record<string, Difference>} */
  const fields = {};
  for (const name of new Set([...Object.keys(old), ...Object.keys(fresh)])) {
    const found = STATIONS_OWN.includes(name) ? null : between(old[name], fresh[name]);
    if (found) fields[name] = found;
  }
  return { kind: "fields", fields };
}

/** What of a mission that flies can still be changed. @param {Difference} difference @returns {Difference | null} */
const ofTrips = (difference) => (difference.kind === "fields" && difference.fields.trips
  ? { kind: "fields", fields: { trips: difference.fields.trips } } : null);

/** @param {KeyedDifference} difference @param {Keyed[]} now @returns {Keyed[]} */
function listWithout({ removed, added, changed, order }, now) {
  const left = new Map(added.map((one) => [one.key, one]));
  let items = now
    .filter((one) => !left.has(one.key) || one.launched === true || !isSame(one, left.get(one.key)))
    .map((one) => {
      const its = changed[one.key] && (one.launched === true ? ofTrips(changed[one.key]) : changed[one.key]);
      return its ? /** @type {Keyed} */ (without(its, one)) : one;
    });
  if (order) {
    const known = new Set(order.to);
    const these = items.filter(({ key }) => known.has(key));
    const kept = new Set(keysOf(these));
    if (isSame(keysOf(these), order.to.filter((key) => kept.has(key)))) {
      const by = new Map(these.map((one) => [one.key, one]));
      const next = order.from.filter((key) => kept.has(key)).values();
      items = items.map((one) => (known.has(one.key) ? /** @type {Keyed} */ (by.get(/** @type {string} */ (next.next().value))) : one));
    }
  }
  for (const { item, before } of removed) {
    if (items.some(({ key }) => key === item.key)) continue;
    const at = items.findLastIndex(({ key }) => before.includes(key));
    items = items.toSpliced(at + 1, 0, item);
  }
  return items;
}

/**
 * Take a difference back: `now` without it, but for what another one has changed since.
 * @param {Difference} difference @param {unknown} now @returns {unknown}
 */
export function without(difference, now) {
  if (difference.kind === "value") return isSame(now, difference.to) ? difference.from : now;
  if (difference.kind === "list") return isKeyed(now) ? listWithout(difference, now) : now;
  if (Array.isArray(now)) return now.map((one, at) => (difference.fields[at] ? without(difference.fields[at], one) : one));
  if (!isThing(now)) return now;
  const fresh = { ...now };
  for (const [name, its] of Object.entries(difference.fields)) {
    const value = without(its, now[name]);
    if (value === undefined) delete fresh[name];
    else fresh[name] = value;
  }
  return fresh;
}

/** The same for a whole plan, as a change of it. @param {Difference} difference @returns {(missions: PlanMission[]) => PlanMission[]} */
export const reverting = (difference) => (missions) =>
  /** @type {PlanMission[]} */ (without(difference, missions));

/**
 * Two differences in a row as one, if both only set the same values: letters that are typed.
 * @param {Difference} first @param {Difference} second @returns {Difference | null}
 */
export function merged(first, second) {
  if (first.kind === "value" && second.kind === "value") return { kind: "value", from: first.from, to: second.to };
  if (first.kind === "fields" && second.kind === "fields") {
    const fields = mergedAll(first.fields, second.fields);
    return fields && { kind: "fields", fields };
  }
  if (first.kind !== "list" || second.kind !== "list") return null;
  if ([first, second].some(({ removed, added, order }) => removed.length || added.length || order)) return null;
  const changed = mergedAll(first.changed, second.changed);
  return changed && { ...second, changed };
}

/** @param {Record<string, Difference>} first @param {Record<string, Difference>} second */
function mergedAll(first, second) {
  const names = Object.keys(first);
  if (!isSame(names.toSorted(), Object.keys(second).toSorted())) return null;
  /** @type {Record<string, Difference>} */
  const all = {};
  for (const name of names) {
    const one = merged(first[name], second[name]);
    if (!one) return null;
    all[name] = one;
  }
  return all;
}

/** The mission and the trip that a difference of a plan touches first. @param {Difference} difference */
export function touched(difference) {
  if (difference.kind !== "list") return { mission: null, trip: null };
  const { added, removed, changed } = difference;
  const mission = Object.keys(changed)[0] ?? added[0]?.key ?? removed[0]?.item.key ?? difference.order?.to[0] ?? null;
  const its = changed[mission ?? ""];
  const trips = its?.kind === "fields" ? its.fields.trips : undefined;
  if (trips?.kind !== "list") return { mission, trip: null };
  return { mission, trip: Object.keys(trips.changed)[0] ?? trips.removed[0]?.item.key ?? trips.added[0]?.key ?? null };
}
