// What is put down is what was picked before: in name and in mass. Pure.

export const PICK = "pick_item";
export const RELEASE = "release_item";

/** For the key of each release, the place in the list of the pick whose item it puts down. @param {readonly PlanTrip[]} trips */
export function picks(trips) {
  /** @type {Map<string, number>} */
  const found = new Map();
  let open = /** @type {number | null} */ (null);
  trips.forEach(({ key, action }, at) => {
    if (action === PICK) open = at;
    if (action !== RELEASE) return;
    if (open !== null) found.set(key, open);
    open = null;
  });
  return found;
}

/** The trips, of which each release has the item of its pick. @param {PlanTrip[]} trips @returns {PlanTrip[]} */
export function linked(trips) {
  const from = picks(trips);
  return trips.map((trip) => {
    const at = from.get(trip.key);
    return at === undefined ? trip : { ...trip, item: trips[at].item };
  });
}
