// What one can do to the trips of the selected mission, with a way back where something goes. What
// is released is always what was picked before, so a release follows its pick through every change.

import { called } from "./actions.js";
import { newKey } from "./dom.js";
import { inMission, moved, withField } from "./api.js";

const PICK = "pick_item";
export const RELEASE = "release_item";

// For the key of each release, the place in the list of the pick whose item it puts down.
export function picks(trips) {
  const found = new Map();
  let open = null;
  trips.forEach(({ key, action }, at) => {
    if (action === PICK) open = at;
    if (action !== RELEASE) return;
    if (open !== null) found.set(key, open);
    open = null;
  });
  return found;
}

function linked(trips) {
  const from = picks(trips);
  return trips.map((trip) =>
    from.has(trip.key) ? { ...trip, item: trips[from.get(trip.key)].item } : trip);
}

export function tripActs({ plan, selected, say, hush }, choose, focus) {
  const mission = () => selected.mission();
  const at = (key) => mission().trips.findIndex((trip) => trip.key === key);
  // change: trips → trips; what it needs it finds by key, as others may have changed the plan
  const edit = (change, typing = false, { key } = mission()) =>
    plan.edit(inMission(key, (now) => ({ ...now, trips: linked(change(now.trips)) })), typing);
  const inTrip = (key, change, typing) =>
    edit((trips) => trips.map((trip) => (trip.key === key ? change(trip) : trip)), typing);
  const has = (trips, { key }) => trips.some((other) => other.key === key);
  const put = (trip, index, where) =>
    edit((trips) => (has(trips, trip) ? trips : trips.toSpliced(index, 0, trip)), false, where);

  return {
    add(action, target) {
      const { trips } = mission();
      const count = trips.filter((trip) => trip.action === PICK).length;
      // how heavy an item is, only people know
      const item = action.item ? { name: count ? `item ${count + 1}` : "item" } : null;
      const trip = { key: newKey(), action: action.name, target, parameters: {}, item };
      put(trip, trips.length);
      choose(trip.key);
      hush(`Trip ${trips.length + 1}, ${called(action.name)}, is on the map.`);
    },
    set: (key, name, value, typing) => inTrip(key, (trip) => withField(trip, name, value), typing),
    setIn: (key, part, name, value, typing) =>
      inTrip(key, (trip) => ({ ...trip, [part]: withField(trip[part] ?? {}, name, value) }), typing),
    place(key, target) {
      inTrip(key, (trip) => ({ ...trip, target: [...target, ...trip.target.slice(2)] }), true);
      hush(`${target.join(", ")} metres.`);
    },
    move(key, to) {
      if (to < 0 || to >= mission().trips.length) return;
      edit((trips) => moved(trips, key, to));
      hush(`It is trip ${to + 1} now.`);
    },
    copy(key) {
      const { name: _, ...trip } = mission().trips[at(key)]; // no two trips have one name
      const fresh = { ...trip, key: newKey() };
      put(fresh, at(key) + 1);
      choose(fresh.key);
    },
    remove(key) {
      const where = mission();
      const index = at(key);
      const trip = where.trips[index];
      edit((trips) => trips.filter((other) => other.key !== key));
      const next = mission().trips[index] ?? mission().trips.at(-1);
      choose(next?.key ?? null);
      if (next) requestAnimationFrame(() => focus(next.key));
      say(`Trip ${index + 1}, ${called(trip.action)}, is deleted.`, {
        undo() {
          put(trip, index, where);
          selected.set(where.key);
          choose(key);
        },
      });
    },
  };
}
