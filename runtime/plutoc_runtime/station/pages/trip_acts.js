// What one can do to the trips of the selected mission, each with a way back where something goes.

import { called } from "./action_signs.js";
import { number } from "./numbers.js";
import * as edits from "./trip_edits.js";
import { newKey } from "./dom.js";

export function tripActs({ app, plan, selected, say, hush }, { choose, focus }) {
  const mission = () => selected.mission();
  const edit = (change, typing = false) => plan.edit(change, typing);
  const at = (key) => mission()?.trips.findIndex((trip) => trip.key === key) ?? -1;
  const metres = (target) => target.slice(0, 2).map(number).join(", ");

  return {
    add(action, target) {
      const now = mission();
      if (!now || now.launched) return;
      const trip = edits.newTrip(action, target, now.trips);
      edit(edits.addTrip(now.key, trip));
      choose(trip.key);
      hush(`Trip ${now.trips.length + 1}, ${called(action.name)}, is at ${metres(target)} metres.`);
    },
    place(key, target) {
      const trip = mission()?.trips[at(key)];
      if (!trip) return;
      edit(edits.setTrip(mission().key, key, "target", [...target, ...trip.target.slice(2)]), true);
      hush(`${metres(target)} metres.`);
    },
    move(key, to) {
      const now = mission();
      if (!now || to < 0 || to >= now.trips.length) return;
      edit(edits.moveTrip(now.key, key, to));
      hush(`It is trip ${to + 1} of ${now.trips.length} now.`);
    },
    copy(key) {
      const fresh = newKey();
      edit(edits.copyTrip(mission().key, key, fresh));
      choose(fresh);
    },
    remove(key) {
      const now = mission();
      const index = at(key);
      if (index < 0 || now.launched) return;
      const trip = now.trips[index];
      edit(edits.deleteTrip(now.key, key));
      const next = mission().trips[Math.min(index, now.trips.length - 2)];
      choose(next?.key ?? null);
      if (next) requestAnimationFrame(() => focus(next.key));
      say(`Trip ${index + 1}, ${called(trip.action)}, is deleted.`, {
        undo() {
          edit(edits.putBackTrip(now.key, trip, index));
          selected.set(now.key);
          choose(trip.key);
        },
      });
    },
    set(key, name, value, typing) {
      edit(edits.setTrip(mission().key, key, name, value), typing);
    },
    parameter(key, name, value, typing) {
      edit(edits.setParameter(mission().key, key, name, value), typing);
    },
    item(key, name, value, typing) {
      edit(edits.setItem(mission().key, key, name, value), typing);
    },
    action(key, name) {
      const action = app.actions.find((one) => one.name === name);
      const { trips } = mission();
      edit(edits.inTrip(mission().key, key, (trip) => edits.withAction(trip, action, trips)));
    },
  };
}
