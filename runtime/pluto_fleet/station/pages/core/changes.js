// Changes of a plan: functions from missions to missions that find what they change by its key, so
// that they can be made again on top of what others have changed meanwhile; and keys and names that are new. Pure.

/** A key that no other browser makes: 32 hexadecimal digits. */
export function newKey() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The first of "Mission 1", "Mission 2", … that is not taken. @param {string} stem @param {string[]} taken @param {number} [from] */
export function freeName(stem, taken, from = 1) {
  const names = new Set(taken.map((name) => name.trim()));
  let number = from;
  while (names.has(`${stem} ${number}`)) number += 1;
  return `${stem} ${number}`;
}

/** @param {PlanMission[]} missions @param {string} key */
const has = (missions, key) => missions.some((mission) => mission.key === key);

/** Change one mission; one that flies stays as it is. @param {string} key @param {(mission: PlanMission) => PlanMission} change @returns {Change} */
const inMission = (key, change) => (missions) =>
  missions.map((mission) => (mission.key === key && !mission.launched ? change(mission) : mission));

/**
 * A copy with a field set; `undefined` takes it away.
 * @template {object} Thing
 * @param {Thing} thing @param {string} name @param {unknown} value @returns {Thing}
 */
export function withField(thing, name, value) {
  const { [name]: _, ...rest } = /** @type {any} */ (thing);
  return value === undefined ? rest : { ...thing, [name]: value };
}

/** @param {string} key @param {string} name @param {unknown} value */
export const setField = (key, name, value) =>
  inMission(key, (mission) => withField(mission, name, value));

/** @param {string} key of the new mission @param {string} stem of its name @param {Partial<PlanMission>} [extra] @returns {Change} */
export const addMission = (key, stem, extra = {}) => (missions) => (has(missions, key) ? missions : [
  ...missions,
  {
    key, launched: false, ended: null, trips: [],
    name: freeName(stem, missions.map(({ name }) => name), missions.length + 1), ...extra,
  },
]);

/** @param {string} key @param {string} fresh the copy's key @returns {Change} */
export function copyMission(key, fresh) {
  /** @type {Map<string, string>} the same new keys each time that the change is made */
  const keys = new Map();
  const another = (/** @type {string} */ old) => {
    if (!keys.has(old)) keys.set(old, newKey());
    return /** @type {string} */ (keys.get(old));
  };
  return (missions) => {
    const at = missions.findIndex((mission) => mission.key === key);
    if (at < 0 || has(missions, fresh)) return missions;
    const original = missions[at];
    const stem = original.name.trim().replace(/ \d+$/, "");
    const copy = {
      ...structuredClone(original),
      key: fresh, launched: false, ended: null,
      name: freeName(stem, missions.map(({ name }) => name), 2),
      trips: original.trips.map((trip) => ({ ...structuredClone(trip), key: another(trip.key) })),
    };
    return missions.toSpliced(at + 1, 0, copy);
  };
}

/** @param {string} key @returns {Change} */
export const removeMission = (key) => (missions) =>
  missions.filter((mission) => mission.key !== key || mission.launched);

/** @template {{ key: string }} Item @param {Item[]} items @param {string} key @param {number} to @returns {Item[]} */
export function moved(items, key, to) {
  const at = items.findIndex((item) => item.key === key);
  if (at < 0) return items;
  return items.toSpliced(at, 1).toSpliced(Math.max(0, to), 0, items[at]);
}

/** Change a mission's trips, also while it flies: the station takes what is not too late. @param {string} mission @param {(trips: PlanTrip[]) => PlanTrip[]} change */
export const inTrips = (mission, change) => (/** @type {PlanMission[]} */ missions) =>
  missions.map((one) => (one.key === mission ? { ...one, trips: change(one.trips) } : one));

/** Each value of a plan, by where it stands. @param {PlanMission[]} missions @returns {Map<string, string>} */
export const leaves = (missions) => new Map(missions.flatMap(({ key, trips = [], launched, ended, ...own }) =>
  [[key, own], ...trips.map(({ key: trip, ...its }) => [`${key} ${trip}`, its])])
  .flatMap(([at, value]) => flat(String(at), value)));

/** @param {string} at @param {unknown} value @returns {[string, string][]} */
function flat(at, value) {
  return value && typeof value === "object"
    ? Object.entries(value).flatMap(([name, one]) => flat(`${at} ${name}`, one))
    : [[at, String(value ?? "")]];
}
