// The line to the station: requests, commands, what happens as it sees it now, and the plan. What
// does not go well is an Error with a sentence for the user, and the answer's status: 0 for none.

import { bell, freeName, newKey } from "./dom.js";

const SILENT = "The station does not answer.";
const TOKEN = "pluto-token";

export const wait = (time) => new Promise((done) => setTimeout(done, time));

// In no cookie: that would go to every port of this machine. Until it is forgotten, a tab keeps its
// own, for its Stop.
let known = localStorage.getItem(TOKEN) ?? "";
export const token = () => known;
export const keepToken = (text) => localStorage.setItem(TOKEN, known = text.trim());
export const forgetToken = () => localStorage.removeItem(TOKEN);
window.addEventListener("storage", ({ key, newValue }) =>
  key === TOKEN && newValue === null && location.reload());

// The token moves out of the page's address at once.
export function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given === null) return;
  keepToken(given);
  history.replaceState(null, "", location.pathname);
}

const trouble = (message, status) => Object.assign(new Error(message), { status });

async function request(method, path, body, type = "application/json", timeout = 8000) {
  const headers = { "X-Pluto": "1" };
  if (token()) headers.Authorization = `Bearer ${token()}`;
  if (body !== undefined) headers["Content-Type"] = type;
  let answer;
  try {
    const signal = AbortSignal.timeout(timeout);
    answer = await fetch(path, { method, headers, body, signal, cache: "no-store" });
  } catch {
    throw trouble(SILENT, 0);
  }
  if (answer.ok || answer.status === 409) return answer; // 409 says how things stand
  const { said } = await answer.json().catch(() => ({}));
  throw trouble(said ?? SILENT, answer.status);
}

export async function send(method, path, content, type, timeout) {
  const body = typeof content === "string" ? content : JSON.stringify(content);
  const answer = await request(method, path, body, type, timeout);
  const data = await answer.json().catch(() => { throw trouble(SILENT, 0); });
  return { status: answer.status, data };
}

export const get = async (path, timeout) =>
  (await send("GET", path, undefined, undefined, timeout)).data;

// → what the station says. Where the answer got lost, it is sent again with the same id, so that it
// is done once; for `patience` ms, as nothing asked for long ago is to happen out of the blue.
export async function command(name, given = {}, patience = 4000) {
  const content = { id: newKey(), ...given };
  const until = performance.now() + patience;
  for (;;) {
    try {
      const { status, data } = await send("POST", `/api/${name}`, content, undefined, 4000);
      if (status === 409) throw trouble(data.said, 409);
      return data.said;
    } catch (error) {
      if (error.status || performance.now() > until) throw error;
    }
    await wait(400);
  }
}

export async function download(path, name) {
  const answer = await request("GET", path, undefined, undefined, 30000);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await answer.blob());
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// The page asks for what is newer than it has seen, and gets the newest, once: nothing queues up;
// by plain requests where the WebSocket fails.
const KEPT = 5000; // lines and results
const SILENCE = 4000; // ms; the station answers after a second at the latest
const POLLS = 30; // so many plain requests before the WebSocket is tried again
const NO_TOKEN = 4401;

const leisure = () => document.hidden && wait(1000);

// Resolves when the line is gone, with how many messages came.
function throughSocket(wanted, take, denied) {
  return new Promise((done) => {
    let count = 0;
    let alarm = 0;
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/api/live`);
    const over = () => {
      clearTimeout(alarm);
      socket.onclose = socket.onmessage = socket.onopen = null;
      socket.close();
      done(count);
    };
    const expect = () => {
      clearTimeout(alarm);
      alarm = setTimeout(over, SILENCE);
    };
    const ask = (more) => {
      expect();
      socket.send(JSON.stringify({ ...more, ...wanted() }));
    };
    expect();
    socket.onopen = () => ask(token() ? { token: token() } : {});
    socket.onclose = ({ code }) => {
      if (code === NO_TOKEN) denied();
      over();
    };
    socket.onmessage = async ({ data }) => {
      expect();
      count += 1;
      take(JSON.parse(data));
      await leisure();
      if (socket.readyState === WebSocket.OPEN) ask();
    };
  });
}

async function byRequests(wanted, take, denied) {
  let count = 0;
  try {
    for (; count < POLLS; count += 1) {
      take(await get(`/api/live?${new URLSearchParams(wanted())}`, SILENCE));
      await leisure();
      await wait(80);
    }
  } catch (error) {
    if (error.status === 401) denied();
  }
  return count;
}

async function keepOn(...how) {
  for (let failed = 0; ;) {
    const requests = failed % 3 === 2;
    const count = await (requests ? byRequests : throughSocket)(...how);
    if (requests && count === POLLS) failed = 1; // they work; one try of the WebSocket
    else failed = count ? 0 : failed + 1;
    await wait(count ? 50 : Math.min(2000, 150 * 2 ** Math.min(failed, 4)));
  }
}

// A result as the tables have it: its facts in order; what was picked or released has no value.
function entry(row) {
  const [of] = row.values;
  const item = row.action === "pick_item" || row.action === "release_item";
  const value = item ? null : row.value ?? "nothing";
  const kind = row.kind === "handling" ? "result" : row.kind;
  const facts = [row.number, row.time, row.mission, row.trip, row.round, row.attempt, row.drone, kind, value];
  const done = [row.action, row.target, row.parameters, of?.quantity, of?.unit ?? null];
  return row.action === null ? facts : [...facts, ...done, ...(row.at ? [row.at] : [])];
}

const fresh = () => ({ missions: new Map(), drones: new Map(), log: [], results: [] });
const nothing = (anew) => ({
  fresh: anew, missions: new Set(), drones: new Set(), log: [], results: [],
});

// changed: once a frame at most; other: another server answers; denied: it wants its token.
export function liveFeed() {
  const live = {
    ...fresh(), server: null, flight: "", n: 0, made: 0, state: { phase: "unknown", time: 0 },
    changed: bell(), other: bell(), denied: bell(),
  };
  let seen = { log: 0, results: 0 };
  let changes = nothing(true);
  let heard = -Infinity;
  let offset = Infinity; // the station's clock against ours, by the quickest message
  let late = 0;
  let drawing = false;

  function forget() {
    Object.assign(live, fresh(), { n: 0, flight: "" });
    seen = { log: 0, results: 0 };
    changes = nothing(true);
  }

  function draw() {
    if (drawing) return;
    drawing = true;
    requestAnimationFrame(() => {
      drawing = false;
      const now = changes;
      changes = nothing(false);
      live.changed.ring(now);
    });
  }

  function take(message) {
    const another = live.server !== null && message.server !== live.server;
    live.server = message.server;
    if (another) { // what it counts is not what the one before counted: ask for everything
      forget();
      offset = Infinity;
      live.other.ring();
      return;
    }
    if (message.flight !== live.flight) forget();
    const { flight, n, made, state } = message;
    Object.assign(live, { flight, n, made, state });
    const way = Date.now() - made;
    offset = Math.min(offset, way);
    late = way - offset;
    heard = performance.now();
    for (const [kind, key] of [["missions", "name"], ["drones", "id"]]) {
      for (const row of message[kind]) {
        live[kind].set(row[key], row);
        changes[kind].add(row[key]);
      }
    }
    for (const kind of ["log", "results"]) {
      const lines = kind === "results" ? message.results.map(entry) : message.log;
      for (const list of [live[kind], changes[kind]]) {
        list.push(...lines);
        if (list.length > KEPT * 1.2) list.splice(0, list.length - KEPT);
      }
      if (lines.length) [seen[kind]] = lines.at(-1);
    }
    draw();
  }

  live.age = () => performance.now() - heard + late;
  live.lost = () => live.age() > 3000;
  live.start = () =>
    keepOn(() => ({ flight: live.flight, seen: live.n, ...seen }), take, live.denied.ring);
  return live;
}

// The plan that all draw together. Changes are functions from missions to missions that find
// what they change by key: seen at once, saved by themselves; where another page was quicker, on top of
// theirs; without a connection, later.
const TYPING = 300; // ms
const BETWEEN = 120; // two savings, also while a pin is dragged

export function planKept() {
  let base = { revision: 0, missions: [], problems: [] };
  let pending = []; // changes that the station does not know yet
  let unanswered = []; // missions that the station may have got all the same
  const drafts = new Map(); // what was typed and cannot be in the plan, by where it stands
  let timer = 0;
  let sending = false;
  let tries = 0;
  let sentAt = -BETWEEN;
  // said: what is wrong with keeping it at the station; trouble: why it is not saved
  const plan = {
    missions: [], problems: [], said: "", trouble: "", loaded: false,
    changed: bell(), refused: bell(),
  };

  function judge() {
    const found = [];
    for (const [at, { mission, trip, field, typed, why, now }] of drafts) {
      const of = plan.missions.find(({ key, launched }) => key === mission && !launched);
      const thing = trip ? of?.trips.find(({ key }) => key === trip) : of;
      if (!thing) drafts.delete(at);
      else {
        const text = `${why} The plan still has ${now(thing) ?? "nothing there"}.`;
        found.push({ mission, trip, field, text, typed });
      }
    }
    plan.problems = [...found, ...base.problems];
    plan.changed.ring();
  }

  function replay() {
    plan.missions = pending.reduce((missions, change) => change(missions), base.missions);
    plan.said = base.said ?? "";
    judge();
  }

  // Where two have written at one place, the later one is told.
  function tell(old, ours) {
    const [was, mine, theirs, lost, now] =
      [old, ours, base.missions, unanswered, plan.missions].map(leaves);
    const said = [];
    for (const [at, value] of mine) {
      const other = theirs.get(at);
      if (value === was.get(at)) continue;
      if (now.get(at) !== value) {
        said.push(`You wrote “${value}”, but another page has removed or started that meanwhile.`);
      } else if (![was.get(at), value, lost.get(at)].includes(other)) {
        said.push(`Another page wrote “${other ?? ""}” while you wrote “${value}” there. `
          + "The plan has yours now.");
      }
    }
    if (said.length) plan.refused.ring(said.slice(0, 3).join("\n"));
  }

  function later(time) {
    clearTimeout(timer);
    timer = setTimeout(save, Math.max(time, sentAt + BETWEEN - performance.now()));
  }

  async function save() {
    clearTimeout(timer);
    if (sending || !pending.length || !plan.loaded) return;
    sending = true;
    sentAt = performance.now();
    const sent = pending.length;
    const content = { revision: base.revision, missions: plan.missions };
    try {
      const { status, data } = await send("PUT", "/api/plan", content);
      const [old, ours] = [base.missions, plan.missions];
      if (status !== 409) pending = pending.slice(sent);
      plan.take(data);
      if (status === 409) tell(old, ours);
      unanswered = [];
    } catch ({ status, message }) {
      if (status === 400 || status === 413) { // the station will never have it
        pending = pending.slice(sent);
        replay();
        plan.refused.ring(message);
      } else {
        tries = Math.min(tries + 1, 3);
        unanswered = content.missions;
        plan.trouble = message;
        plan.changed.ring();
      }
    }
    sending = false;
    if (pending.length) later(tries ? Math.min(2000, 250 * 2 ** tries) : 0);
  }

  plan.take = (fresh) => {
    base = fresh;
    plan.loaded = true;
    plan.trouble = "";
    tries = 0;
    replay();
  };
  plan.load = async () => {
    const fresh = await get("/api/plan");
    if (!sending && (!plan.loaded || fresh.revision !== base.revision)) plan.take(fresh);
    if (pending.length) later(0);
  };
  plan.revision = () => base.revision;
  plan.unsaved = () => pending.length > 0;
  plan.saved = async () => {
    if (pending.length) later(0);
    for (let i = 0; pending.length && i < 100; i += 1) await wait(30);
    return !pending.length;
  };
  plan.edit = (change, typing = false) => {
    pending.push(change);
    plan.missions = change(plan.missions);
    judge();
    later(typing ? TYPING : 0);
  };
  // draft: { typed, why, now: thing → its value in the plan }, or nothing
  plan.draft = (mission, trip, field, draft) => {
    const at = [mission, trip, field].join();
    if (!draft && !drafts.delete(at)) return;
    if (draft) drafts.set(at, { mission, trip, field, ...draft });
    judge();
  };
  return plan;
}

export function selection(plan) {
  const selected = { key: null, changed: bell() };
  selected.mission = () => plan.missions.find(({ key }) => key === selected.key) ?? null;
  selected.set = (key) => {
    if (key === selected.key) return;
    selected.key = key;
    selected.changed.ring();
  };
  plan.changed.heard(() => selected.mission() || selected.set(null));
  return selected;
}

// Each value of a plan as it is written, by where it stands.
const leaves = (missions) => new Map(missions.flatMap(({ key, trips, launched, ...own }) =>
  [[key, own], ...trips.map(({ key: trip, ...its }) => [`${key} ${trip}`, its])])
  .flatMap(function flat([at, value]) {
    return value && typeof value === "object"
      ? Object.entries(value).flatMap(([name, one]) => flat([`${at} ${name}`, one]))
      : [[at, String(value ?? "")]];
  }));

const names = (missions) => missions.map(({ name }) => name);
const has = (missions, key) => missions.some((mission) => mission.key === key);

// change: mission → mission. Those that fly stay as they are.
export const inMission = (key, change) => (missions) =>
  missions.map((mission) =>
    mission.key === key && !mission.launched ? change(mission) : mission);

// undefined takes the field away
export function withField(thing, name, value) {
  const { [name]: _, ...rest } = thing;
  return value === undefined ? rest : { ...thing, [name]: value };
}

export const setField = (key, name, value) =>
  inMission(key, (mission) => withField(mission, name, value));

export const addMission = (key, extra = {}) => (missions) => has(missions, key) ? missions : [
  ...missions,
  { key, name: freeName("Mission", names(missions), missions.length + 1), trips: [], ...extra },
];

export function copyMission(key, fresh) {
  const keys = new Map(); // the same new keys each time that the change is made
  const another = (old) => keys.get(old) ?? keys.set(old, newKey()).get(old);
  return (missions) => {
    const at = missions.findIndex((mission) => mission.key === key);
    if (at < 0 || has(missions, fresh)) return missions;
    const { launched, name, trips, ...rest } = missions[at];
    return missions.toSpliced(at + 1, 0, {
      ...rest, key: fresh, name: freeName(name.trim().replace(/ \d+$/, ""), names(missions), 2),
      trips: trips.map((trip) => ({ ...trip, key: another(trip.key) })),
    });
  };
}

export const deleteMission = (key) => (missions) =>
  missions.filter((mission) => mission.key !== key || mission.launched);

export const putBack = (mission, index) => (missions) =>
  has(missions, mission.key) ? missions : missions.toSpliced(index, 0, mission);

export function moved(list, key, to) {
  const from = list.findIndex((thing) => thing.key === key);
  if (from < 0) return list;
  const rest = list.toSpliced(from, 1);
  return rest.toSpliced(Math.max(0, Math.min(to, rest.length)), 0, list[from]);
}
