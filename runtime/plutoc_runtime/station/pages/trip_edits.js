// The changes of a mission's trips, for `plan.edit`. What is released is always what was picked
// before, so a release follows its pick through every change.

import { inMission, moved, withField } from "./plan.js";
import { newKey } from "./dom.js";

export const PICK = "pick_item";
export const RELEASE = "release_item";

export const inTrips = (mission, change) =>
  inMission(mission, (now) => ({ ...now, trips: linked(change(now.trips)) }));

/** change: trip → trip */
export const inTrip = (mission, key, change) =>
  inTrips(mission, (trips) => trips.map((trip) => (trip.key === key ? change(trip) : trip)));

export const setTrip = (mission, key, name, value) =>
  inTrip(mission, key, (trip) => withField(trip, name, value));

export const setParameter = (mission, key, name, value) =>
  inTrip(mission, key, (trip) => ({
    ...trip, parameters: withField(trip.parameters ?? {}, name, value),
  }));

export const setItem = (mission, key, name, value) =>
  inTrip(mission, key, (trip) => ({ ...trip, item: withField(trip.item ?? {}, name, value) }));

export const addTrip = (mission, trip) =>
  inTrips(mission, (trips) =>
    trips.some((other) => other.key === trip.key) ? trips : [...trips, trip]);

export const deleteTrip = (mission, key) =>
  inTrips(mission, (trips) => trips.filter((trip) => trip.key !== key));

export const moveTrip = (mission, key, to) =>
  inTrips(mission, (trips) => moved(trips, key, to));

/** Puts back what was deleted. */
export const putBackTrip = (mission, trip, index) =>
  inTrips(mission, (trips) =>
    trips.some((other) => other.key === trip.key) ? trips : trips.toSpliced(index, 0, trip));

export function copyTrip(mission, key, fresh) {
  return inTrips(mission, (trips) => {
    const at = trips.findIndex((trip) => trip.key === key);
    if (at < 0 || trips.some((trip) => trip.key === fresh)) return trips;
    const { name: _, ...rest } = trips[at]; // no two trips of a mission have one name
    return trips.toSpliced(at + 1, 0, { ...rest, key: fresh });
  });
}

/** A trip as it is when an action has just been put somewhere. */
export function newTrip(action, target, trips) {
  const trip = { key: newKey(), action: action.name, target, parameters: {}, item: null };
  return action.item ? { ...trip, item: newItem(trips) } : trip;
}

/** Another action for a trip: its place and name stay. */
export function withAction(trip, action, trips) {
  if (trip.action === action.name) return trip;
  const item = action.item ? trip.item ?? newItem(trips) : null;
  return { ...trip, action: action.name, parameters: {}, item };
}

function newItem(trips) {
  const picks = trips.filter((trip) => trip.action === PICK).length;
  return { name: picks ? `item ${picks + 1}` : "item" }; // how heavy it is, only people know
}

/** For each release, the place in the list of the pick before it whose item it puts down. */
export function picks(trips) {
  const found = new Map();
  let open = null;
  trips.forEach((trip, index) => {
    if (trip.action === PICK) open = index;
    if (trip.action !== RELEASE) return;
    if (open !== null) found.set(trip.key, open);
    open = null;
  });
  return found;
}

function linked(trips) {
  const from = picks(trips);
  return trips.map((trip) => {
    const pick = from.has(trip.key) ? trips[from.get(trip.key)] : null;
    const same = !pick || (pick.item?.name === trip.item?.name && pick.item?.mass === trip.item?.mass);
    return same ? trip : { ...trip, item: pick.item };
  });
}
