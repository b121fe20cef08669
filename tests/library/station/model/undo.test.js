import assert from "node:assert/strict";
import { test } from "node:test";
import { addMission, inTrips, moved, removeMission, setField, withField } from "../../../../runtime/pluto_fleet/station/pages/core/changes.js";
import { between, isSame, reverting, Undo } from "../../../../runtime/pluto_fleet/station/pages/core/undo.js";

const addTrips = (/** @type {string} */ mission, /** @type {any[]} */ fresh, at = 0) =>
  inTrips(mission, (trips) => trips.toSpliced(at, 0, ...fresh));
const removeTrips = (/** @type {string} */ mission, /** @type {string[]} */ keys) =>
  inTrips(mission, (trips) => trips.filter(({ key }) => !keys.includes(key)));
const inTrip = (/** @type {string} */ mission, /** @type {string} */ trip, /** @type {(one: any) => any} */ change) =>
  inTrips(mission, (trips) => trips.map((one) => (one.key === trip ? change(one) : one)));

/** The same numbers for the same seed. @param {number} seed */
function dice(seed) {
  let state = seed;
  return (/** @type {number} */ sides) => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return Math.floor((state / 2147483648) * sides);
  };
}

/** @param {ReturnType<typeof dice>} roll @param {any[]} missions @param {string} who */
function randomChange(roll, missions, who) {
  const key = `${who}-${roll(1e9)}`;
  const mission = missions[roll(missions.length)];
  const trip = mission?.trips[roll(mission.trips.length)];
  const kind = mission ? roll(trip ? 8 : 4) : 0;
  return [
    () => addMission(key, "Mission"),
    () => setField(mission.key, "name", key),
    () => addTrips(mission.key, [{ key, action: "measure", target: [roll(9), roll(9)], parameters: {}, item: null }], roll(3)),
    () => (/** @type {any} */ all) => moved(all, mission.key, roll(all.length)),
    () => removeTrips(mission.key, [trip.key]),
    () => inTrip(mission.key, trip.key, (one) => ({ ...one, target: [roll(9), one.target?.[1] ?? 0] })),
    () => inTrip(mission.key, trip.key, (one) => ({ ...one, parameters: withField(one.parameters, "quantity", key) })),
    () => removeMission(mission.key),
  ][kind]();
}

/** A plan with its undo. */
function drawing() {
  const undo = new Undo(() => 0);
  const plan = { missions: /** @type {any[]} */ ([]) };
  const edit = (/** @type {any} */ change) => { plan.missions = change(plan.missions); return plan.missions; };
  return {
    undo, plan, edit,
    draw(/** @type {any} */ change, typing = false) {
      const before = plan.missions;
      undo.record(before, edit(change), typing);
    },
    step: (/** @type {"undo" | "redo"} */ way) => undo.step(plan.missions, edit, way),
  };
}

test("what one draws alone is undone and done again, step by step, whatever it was", () => {
  for (let seed = 1; seed < 40; seed += 1) {
    const [roll, one] = [dice(seed), drawing()];
    const states = [one.plan.missions];
    for (let i = 0; i < 30; i += 1) {
      one.draw(randomChange(roll, one.plan.missions, "me"));
      if (!isSame(states.at(-1), one.plan.missions)) states.push(one.plan.missions);
    }
    for (const state of states.slice(0, -1).reverse()) {
      assert.ok(one.step("undo"));
      assert.ok(isSame(one.plan.missions, state), `undo, seed ${seed}`);
    }
    assert.equal(one.step("undo"), null);
    for (const state of states.slice(1)) {
      assert.ok(one.step("redo"));
      assert.ok(isSame(one.plan.missions, state), `redo, seed ${seed}`);
    }
    assert.equal(one.step("redo"), null);
  }
});

test("what others have drawn is never undone", () => {
  for (let seed = 1; seed < 40; seed += 1) {
    const [roll, one] = [dice(seed), drawing()];
    for (let i = 0; i < 20; i += 1) {
      one.draw(randomChange(roll, one.plan.missions, "me"));
      one.edit(addMission(`their-${i}`, "Theirs"));
      one.edit(addTrips(`their-${i}`, [{ key: `their-trip-${i}`, action: "measure", target: [1, 1], parameters: {}, item: null }]));
    }
    const isTheirs = (/** @type {any} */ mission) => mission.key.startsWith("their") && mission.trips.some((/** @type {any} */ trip) => trip.key.startsWith("their"));
    const left = one.plan.missions.filter(isTheirs).map(({ key }) => key);
    while (one.step("undo"));
    for (const key of left) assert.ok(one.plan.missions.some((mission) => mission.key === key), `${key}, seed ${seed}`);
    const keys = one.plan.missions.flatMap((mission) => [mission.key, ...mission.trips.map((/** @type {any} */ trip) => trip.key)]);
    assert.equal(new Set(keys).size, keys.length, "no key is there twice");
  }
});

test("a value that another one has written since stays, and the rest of the step goes", () => {
  const one = drawing();
  one.edit(addMission("mission-1", "Mission"));
  one.edit(addTrips("mission-1", [{ key: "trip-1", action: "measure", target: [1, 2], parameters: {}, item: null }]));
  one.draw(inTrip("mission-1", "trip-1", (trip) => ({ ...trip, target: [5, 6] })));
  one.edit(inTrip("mission-1", "trip-1", (trip) => ({ ...trip, target: [5, 9] })));
  one.step("undo");
  assert.deepEqual(one.plan.missions[0].trips[0].target, [1, 9]);
});

test("letters typed one after another are one step, and a pause begins another", () => {
  let now = 0;
  const undo = new Undo(() => now);
  const names = ["", "B", "Be", "Bed"].map((name) => [{ key: "mission-1", name, launched: false, ended: null, trips: [] }]);
  undo.record(names[0], names[1], true);
  undo.record(names[1], names[2], true);
  assert.equal(undo.done.value.length, 1);
  now = 10000;
  undo.record(names[2], names[3], true);
  assert.equal(undo.done.value.length, 2);
  assert.ok(isSame(reverting(undo.done.value[0].difference)(names[2]), names[0]));
});

test("a mission that flies by now is neither changed nor removed", () => {
  const one = drawing();
  one.draw(addMission("mission-1", "Mission"));
  one.draw(setField("mission-1", "name", "Other"));
  one.plan.missions = [{ ...one.plan.missions[0], launched: true }];
  assert.equal(one.step("undo"), null);
  assert.equal(one.plan.missions[0].name, "Other");
});

test("it is kept as text, and goes on from there", () => {
  const one = drawing();
  one.draw(addMission("mission-1", "Mission"));
  const other = new Undo();
  other.restore(one.undo.kept());
  other.step(one.plan.missions, one.edit, "undo");
  assert.deepEqual(one.plan.missions, []);
});

test("what the station alone sets is no difference", () => {
  const mission = { key: "mission-1", name: "A", launched: false, ended: null, trips: [] };
  assert.equal(between([mission], [{ ...mission, launched: true, ended: "FAILED" }]), null);
});

test("a step remembers of a large mission what it has changed, and no more", () => {
  const trips = Array.from({ length: 2000 }, (_, n) => ({ key: `t${n}`, action: "measure", target: [n, 1], parameters: {}, item: null }));
  const before = /** @type {any[]} */ ([{ key: "m", name: "Survey", trips }]);
  const step = between(before, inTrip("m", "t7", (one) => ({ ...one, target: [0, 0] }))(before));
  const kept = /** @type {any} */ (step).after[0].trips.filter((/** @type {object} */ one) => Object.keys(one).length > 1);
  assert.deepEqual(kept, [{ ...trips[7], target: [0, 0] }]);
});
