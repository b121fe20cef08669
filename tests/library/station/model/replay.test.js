import assert from "node:assert/strict";
import { test } from "node:test";
import { World } from "../../../../runtime/pluto_fleet/station/pages/core/world.js";
import { marksOf, nextMark } from "../../../../runtime/pluto_fleet/station/pages/history/playback.js";
import { linesOf } from "../../../../runtime/pluto_fleet/station/pages/history/playback.js";
import { Playback } from "../../../../runtime/pluto_fleet/station/pages/history/playback.js";
import { countUntil } from "../../../../runtime/pluto_fleet/station/pages/history/moments.js";
import { Replayer } from "../../../../runtime/pluto_fleet/station/pages/history/replayer.js";

const STATE = { phase: "flying", time: 0, plan: 1, map: 0, said: "", how: null, busy: "" };
const LENGTH = 100;

/** A recording: at every second one drone is another, at every third a mission; mission B begins at 40. */
const FRAMES = Array.from({ length: LENGTH + 1 }, (_, t) => ({
  t,
  state: { ...STATE, time: t, phase: t < LENGTH ? "flying" : "over" },
  drones: [{ id: `d${t % 3}`, x: t, battery: 1 - t / 200 }],
  missions: t % 3 ? [] : [{ name: t < 40 || t % 2 ? "A" : "B", done: t }],
  alerts: t === 50 ? [{ id: "late", since_at: 0 }] : [],
}));
const LOG = Array.from({ length: 50 }, (_, at) => ({ number: at + 1, time: at * 2, mission: "A", text: `line ${at}`, kind: at === 20 ? "bad" : "info" }));
const RESULTS = Array.from({ length: 10 }, (_, at) => ({ number: at + 1, time: at * 10 }));

/** What all frames up to an instant say, applied one after the other. */
function expected(t) {
  const rows = { missions: new Map(), drones: new Map(), alerts: new Map() };
  for (const frame of FRAMES.filter((one) => one.t <= t)) {
    frame.missions.forEach((row) => rows.missions.set(row.name, row));
    frame.drones.forEach((row) => rows.drones.set(row.id, row));
    frame.alerts.forEach((row) => rows.alerts.set(row.id, row));
  }
  const sorted = (map) => [...map].sort(([a], [b]) => (a < b ? -1 : 1)).map(([, row]) => row);
  return {
    missions: sorted(rows.missions), drones: sorted(rows.drones), alerts: sorted(rows.alerts),
    log: LOG.filter(({ time }) => time <= t).map(({ number }) => number),
    results: RESULTS.filter(({ time }) => time <= t).map(({ number }) => number),
    phase: FRAMES[Math.floor(t)].state.phase,
  };
}

const shown = (world) => {
  const sorted = (rows, key) => rows.all().sort((a, b) => (a[key] < b[key] ? -1 : 1));
  return {
    missions: sorted(world.missions, "name"), drones: sorted(world.drones, "id"), alerts: sorted(world.alerts, "id"),
    log: world.log.entries.value.map(({ number }) => number),
    results: world.results.entries.value.map(({ number }) => number),
    phase: world.state.value.phase,
  };
};

/** A station that gives parts of so many seconds, each from a keyframe on. */
function station(seconds) {
  const asked = [];
  return {
    asked,
    fetchPart: async (from) => {
      asked.push(from);
      const key = expected(from);
      const next = from + seconds <= LENGTH ? from + seconds : null;
      const later = FRAMES.filter(({ t }) => t > from && (next === null || t < next));
      const keyframe = { t: from, state: { ...STATE, time: from, phase: key.phase }, missions: key.missions, drones: key.drones, alerts: key.alerts };
      return {
        flight: "f", begun_at: 0, recorded: true, said: "", seconds: LENGTH, frames: [keyframe, ...later], next,
        log: from ? [] : LOG, results: from ? [] : RESULTS, alerts: [], batteries: {},
      };
    },
  };
}

for (const seconds of [1000, 25, 7]) {
  test(`every instant is what all frames up to it say, whatever was seen before (parts of ${seconds} s)`, async () => {
    const replayer = new Replayer(new World(), station(seconds).fetchPart);
    await replayer.open();
    assert.deepEqual(shown(replayer.world), expected(0));
    for (const t of [0.5, 3, 3.2, 60, 61, 12, 99.9, 100, 0, 41.5, 40, 39.9, 88, 5]) {
      assert.equal(await replayer.seek(t), true);
      assert.deepEqual(shown(replayer.world), expected(t), `at ${t}`);
      assert.equal(replayer.world.state.value.time, t);
    }
  });
}

test("what began later is gone again where the replay is before it", async () => {
  const replayer = new Replayer(new World(), station(1000).fetchPart);
  await replayer.open();
  await replayer.seek(80);
  assert.deepEqual([...replayer.world.missions.keys.value], ["A", "B"]);
  const row = replayer.world.missions.rows.get("A");
  await replayer.seek(20);
  assert.deepEqual(replayer.world.missions.keys.value, ["A"]);
  assert.equal(replayer.world.missions.rows.get("A"), row, "what stays keeps its signal");
});

test("a part is fetched when it is needed, once, and the next one a little before", async () => {
  const { fetchPart, asked } = station(30);
  const replayer = new Replayer(new World(), fetchPart);
  await replayer.open();
  assert.deepEqual(asked, [0]);
  replayer.show(20);
  replayer.ahead(20, 1);
  assert.deepEqual(asked, [0]);
  replayer.ahead(27, 1);
  replayer.ahead(27.1, 1);
  assert.deepEqual(asked, [0, 30]);
  await replayer.fetching.get(30);
  assert.equal(replayer.show(31), true);
  assert.equal(replayer.show(95), false);
  assert.deepEqual(shown(replayer.world), expected(31), "what is not here is not shown");
});

test("of two instants that were asked for, the later asked one is shown", async () => {
  const replayer = new Replayer(new World(), station(30).fetchPart);
  await replayer.open();
  const [first, second] = await Promise.all([replayer.seek(95), replayer.seek(65)]);
  assert.deepEqual([first, second], [false, true]);
  assert.deepEqual(shown(replayer.world), expected(65));
});

test("a part that does not hold what was asked for is told, and not asked for again and again", async () => {
  const { fetchPart } = station(30);
  const replayer = new Replayer(new World(), () => fetchPart(0));
  await replayer.open();
  await assert.rejects(replayer.seek(95), /from 90 s on/);
});

test("a recording of nothing shows nothing, and waits for nothing", async () => {
  const empty = { flight: "f", begun_at: null, recorded: false, said: "", seconds: 0, frames: [], next: null, log: [], results: [], alerts: [], batteries: {} };
  const replayer = new Replayer(new World(), async () => empty);
  await replayer.open();
  assert.equal(await replayer.seek(10), true);
  assert.equal(replayer.world.state.value.known, false);
});

test("entries are counted up to an instant, it included", () => {
  const times = [0, 1, 1, 4].map((time) => ({ time }));
  assert.deepEqual([-1, 0, 1, 3.9, 9].map((t) => countUntil(times, t, ({ time }) => time)), [0, 1, 3, 3, 4]);
});

test("the clock runs at its speed, stands at the end, and begins anew from there", () => {
  const playback = new Playback(20);
  playback.toggle();
  playback.speed.value = 10;
  playback.tick(1.5);
  assert.equal(playback.time.value, 15);
  playback.tick(1);
  assert.deepEqual([playback.time.value, playback.isPlaying.value], [20, false]);
  playback.tick(1);
  assert.equal(playback.time.value, 20);
  playback.toggle();
  assert.deepEqual([playback.time.value, playback.isPlaying.value], [0, true]);
});

test("keys move the clock within the flight, and other keys do nothing", () => {
  const playback = new Playback(40);
  const press = (key, shiftKey = false) => playback.press({ key, shiftKey });
  press("ArrowRight");
  press("ArrowRight", true);
  assert.equal(playback.time.value, 35);
  press("ArrowRight", true);
  assert.equal(playback.time.value, 40);
  press("Home");
  press("ArrowLeft");
  assert.equal(playback.time.value, 0);
  assert.equal(press("x"), false);
  assert.equal(press(" "), true);
  assert.equal(playback.isPlaying.value, true);
});

test("trouble in the console is a mark, what happened within a second the same one", () => {
  const line = (time, kind, text) => ({ number: 1, time, mission: "M", text, kind });
  const marks = marksOf({ seconds: 20, log: [line(1, "info", "a"), line(5, "bad", "b"), line(5.5, "bad", "c"), line(9, "bad", "d")] });
  assert.deepEqual(marks, [{ time: 5, text: "M: b\nM: c" }, { time: 9, text: "M: d" }]);
  assert.equal(nextMark(marks, 5, 1), marks[1]);
  assert.equal(nextMark(marks, 9, -1), marks[0]);
  assert.equal(nextMark(marks, 9, 1), undefined);
});

test("a line of levels keeps its lowest point, however many there are", () => {
  const pairs = Array.from({ length: 5000 }, (_, at) => [at, at === 3333 ? 0.07 : 0.9]);
  const [ten, two] = [{ lowest: 0.07 }, { lowest: 0.5 }];
  const lines = linesOf({ "drone 10": pairs, "drone 2": [[0, 1], [5000, 0.5]], "drone 3": [] }, 5000);
  assert.deepEqual(lines.map(({ drone, lowest }) => [drone, lowest]), [["drone 2", two.lowest], ["drone 10", ten.lowest]]);
  assert.equal(lines[0].points, "0.0,0.0 1000.0,50.0");
  assert.ok(lines[1].points.includes(",93.0"));
  assert.ok(lines[1].points.split(" ").length <= 300);
});
