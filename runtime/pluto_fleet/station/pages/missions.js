// The pages on which a plan is drawn, and Help. Nothing asks before it acts; what was deleted can be
// brought back.

import {
  addMission, copyMission, deleteMission, download, forgetToken, inMission, moved, putBack, send,
  setField, token, withField,
} from "./api.js";
import {
  button, fieldFor, fill, h, icon, inWords, keyed, many, newKey, plain, put, reorderable, set, shown,
  TIME, unique,
} from "./dom.js";
import { actions, actionSign, called, floorPlan, metres, pins, whyNot } from "./floor.js";

// How a mission ended that is still as it was when it flew: text, kind, sign.
const ENDED = {
  COMPLETED: ["Completed", "good", "good"],
  FAILED: ["Failed", "bad", "bad"],
  CANCELLED: ["Cancelled", "", "close"],
  BROKEN_OFF: ["Broken off", "warn", "warning"],
};

// "2 trips · Amato · due 20 min · after Bed 1": what one tells missions apart by.
function inShort({ trips, deadline, after = [], ...mission }, fields) {
  const texts = fields.mission.filter(({ own, type }) => own && type === "text");
  return [
    trips.length ? many(trips.length, "trip") : "no trips yet",
    ...texts.map(({ name }) => mission[name]),
    deadline !== undefined && `due ${inWords(deadline, TIME)}`,
    after.length > 0 && `after ${after.length === 1 ? after[0] : many(after.length, "other")}`,
  ].filter(Boolean).join(" · ");
}

function missionList({ fields, select, open, rename, remove, move }) {
  let missions = [];
  let selected = null;
  const act = (what) => ({ target }) => {
    const at = [...element.children].findIndex((item) => item.contains(target));
    if (missions[at]) what(missions[at].key);
  };
  const element = h("ol", {
    class: "mission-list", role: "listbox", tabIndex: 0, "aria-label": "Missions",
    onclick: act(select), ondblclick: act(open),
    onkeydown(event) {
      const at = missions.findIndex(({ key }) => key === selected);
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (step && event.altKey && at >= 0) move(selected, at + step);
      else if (step && missions.length) select((missions[at + step] ?? missions.at(at)).key);
      else if (at < 0) return;
      else if (event.key === "Enter") open(selected);
      else if (event.key === "F2") rename();
      else if (event.key === "Delete") remove(selected);
      else return;
      event.preventDefault();
    },
  });
  reorderable(element, (from, to) => {
    const { key } = missions[from];
    move(key, to);
    select(key);
  });

  const make = () => h("li", { class: "mission", role: "option", id: unique("mission") },
    h("span", { class: "grip" }, icon("grip")), h("span", { class: "mission-number num" }),
    h("span", { class: "mission-words" }, h("strong"), h("span", { class: "hint" })),
    h("span", { class: "chip" }));

  // A mission that is only not finished yet has nothing wrong with it.
  function mark({ key, trips, launched, ended, ...mission }, problems) {
    const of = problems.filter((problem) => problem.mission === key);
    const empty = ({ trip, field }) => !trip && fields.mission.some(({ name, needed }) =>
      needed && name === field && mission[name] === undefined);
    if (launched) return ["Started", "info", "lock"];
    if (of.some((one) => !empty(one) && (trips.length || one.field))) {
      return ["To mend", "warn", "warning"];
    }
    if (of.length) return ["To do", ""];
    return ENDED[ended] ?? [];
  }

  function update(node, mission, i, problems) {
    const [, count, words, chip] = node.children;
    put(count, i + 1);
    put(words.firstChild, mission.name.trim() || "Without a name");
    put(words.lastChild, inShort(mission, fields));
    const [text = "", kind, sign] = mark(mission, problems);
    set(chip, "class", `chip ${kind}`);
    fill(shown(chip, text), sign && icon(sign), text);
    const now = mission.key === selected;
    if (now && node.ariaSelected !== "true") {
      requestAnimationFrame(() => node.scrollIntoView({ block: "nearest" }));
    }
    set(node, "aria-selected", String(now));
    if (now) set(element, "aria-activedescendant", node.id);
  }

  return {
    element,
    update(fresh, key, problems) {
      [missions, selected] = [fresh, key];
      if (key === null) set(element, "aria-activedescendant", null);
      keyed(element, missions, (mission) => mission.key, make,
        (node, mission, i) => update(node, mission, i, problems));
    },
  };
}

// What may be promised of a mission, whatever the app's graph is.
const MOMENTS = [
  { name: "opens", type: "time", label: "Begins at the soonest", hint: "such as 08:00 or 5 min" },
  { name: "deadline", type: "time", label: "Due", hint: "such as 08:30 or 20 min" },
];

// Which of the other missions must have completed before, each with a box to tick.
function afterField(change) {
  const list = h("div", { class: "choices" });
  const problem = h("p", { class: "problem", id: unique("after") });
  const ticked = () => [...list.querySelectorAll("input:checked")].map(({ value }) => value);
  const element = h("fieldset", { class: "field", "data-field": "after", "aria-describedby": problem.id },
    h("legend", {}, "Begins after"), list, problem);
  return {
    element,
    input: { focus: () => list.querySelector("input")?.focus() },
    update(names, chosen = [], { problem: text = "", locked = false } = {}) {
      element.disabled = locked;
      keyed(list, [...new Set([...names, ...chosen])], (name) => name, (name) => {
        const box = h("input", { type: "checkbox", value: name, onchange: () => change(ticked()) });
        return h("label", { class: "check" }, box, name);
      }, (label, name) => { label.firstChild.checked = chosen.includes(name); });
      fill(shown(problem, text), icon("warning"), text);
    },
  };
}

// ["listen", "listen", "measure"] → "listen × 2, measure"
function listed(words) {
  const runs = [];
  for (const word of words) {
    if (runs.at(-1)?.word === word) runs.at(-1).count += 1;
    else runs.push({ word, count: 1 });
  }
  const said = runs.slice(0, 20).map(({ word, count }) => (count > 1 ? `${word} × ${count}` : word));
  return `${said.join(", ")}${runs.length > 20 ? ", …" : ""}`;
}

const ownFirst = (fields) => fields.toSorted((a, b) => Boolean(b.own) - Boolean(a.own));

function missionPanel({ app, plan, begun }, { open, copy, remove }) {
  let now = null;
  const inputs = [{ name: "name", type: "text" }, ...MOMENTS, ...ownFirst(app.fields.mission)].map((field) =>
    [field.name, fieldFor(field, {
      evaluators: app.evaluators,
      change(value, typing, draft) {
        if (!now) return;
        plan.draft(now.key, null, field.name, draft && { ...draft, now: (one) => one[field.name] });
        if (draft) return;
        plan.edit(setField(now.key, field.name, field.name === "name" ? value ?? "" : value), typing);
      },
    })]);
  const [[, title], ...others] = inputs;
  const promised = others.splice(0, MOMENTS.length);
  const after = afterField((names) =>
    plan.edit(setField(now.key, "after", names.length ? names : undefined)));
  const promises = h("details", { class: "promises" },
    h("summary", {}, "When it begins, and when it is due"),
    h("div", { class: "fields" }, promised.map(([, input]) => input.element), after.element));
  const trips = button("Set trips", () => open(now.key), "primary");
  title.element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    trips.focus();
  });
  const locked = h("p", { class: "row" }, icon("lock"),
    "It has been started: it can be changed again when it has ended.");
  const said = h("div", { class: "stack" });
  const count = h("h3");
  const short = h("p", { class: "hint" });
  const bin = button("Delete", () => remove(now.key));
  const alone = button("Start only this", () => begun([now.key]), "", "start");
  return {
    element: h("section", { class: "card mission-panel stack", "aria-label": "Selected mission" },
      locked, title.element, said,
      others.length > 0 && h("div", { class: "fields" }, others.map(([, input]) => input.element)),
      promises,
      h("div", { class: "row" }, count, h("span", { class: "spread" }, trips)), short,
      h("div", { class: "row" }, alone, button("Copy", () => copy(now.key)), bin)),
    rename() {
      title.input.focus();
      title.input.select();
    },
    lead(field) {
      promises.open ||= ["opens", "deadline", "after"].includes(field);
      const its = field === "after" ? after : inputs.find(([name]) => name === field)?.[1];
      (its?.input ?? trips).focus();
    },
    update(mission, problems) {
      if (now?.key !== mission.key) title.input.blur();
      now = mission;
      const of = problems.filter((problem) => problem.mission === mission.key);
      for (const [name, input] of inputs) {
        const { text: problem, typed = mission[name] } =
          of.find(({ trip, field }) => !trip && field === name) ?? {};
        input.update(typed, { problem, locked: mission.launched });
      }
      const others = plan.missions.filter(({ key }) => key !== mission.key).map(({ name }) => name);
      const { text: problem } = of.find(({ trip, field }) => !trip && field === "after") ?? {};
      after.update(others, mission.after, { problem, locked: mission.launched });
      if (mission.opens ?? mission.deadline ?? mission.after) promises.open = true;
      const told = of.filter(({ trip, field }) => mission.trips.length
        && (trip || (field !== "after" && !inputs.some(([name]) => name === field))));
      fill(said, told.slice(0, 5).map(({ trip, text }) => {
        const at = mission.trips.findIndex(({ key }) => key === trip) + 1;
        return h("p", { class: "problem" }, icon("warning"), at ? `Trip ${at}: ${text}` : text);
      }));
      put(count, mission.trips.length ? many(mission.trips.length, "trip") : "Trips");
      put(trips.lastChild, mission.launched ? "See trips" : "Set trips");
      put(short, listed(mission.trips.map(({ action }) => plain(action)))
        || "No trips yet. “Set trips” opens the map: drag actions onto it there.");
      shown(locked, mission.launched);
      bin.disabled = alone.disabled = mission.launched;
    },
  };
}

const without = (missions, others) =>
  missions.filter(({ key }) => !others.some((other) => other.key === key));

async function another({ plan, say, selected }, ask, said) {
  await plan.saved();
  const before = plan.missions;
  try {
    const { status, data } = await ask(plan.revision());
    if (!data.missions) throw new Error(data.said);
    plan.take(data);
    if (status === 409) throw new Error("Another page changed the plan meanwhile: try again.");
  } catch (error) {
    say(error.message, { bad: true });
    return;
  }
  const after = plan.missions;
  selected.set(after.find(({ launched }) => !launched)?.key ?? null);
  const came = without(after, before); // what was done since then stays
  say(said, {
    settles: true,
    undo: () => plan.edit((now) => [...without(now, came), ...without(before, now)]),
  });
}

const example = (context) => another(context,
  (revision) => send("POST", "/api/plan/example", { revision }),
  "The example plan is here: look at it, change it, or press Start.");

function importFile(context) {
  const input = h("input", {
    type: "file", accept: ".toml",
    async onchange() {
      const [file] = input.files;
      const text = await file.text();
      another(context, (revision) =>
        send("POST", `/api/plan/import?revision=${revision}&file=${encodeURIComponent(file.name)}`,
          text, "application/toml"),
      `${file.name} is in the plan now.`);
    },
  });
  input.click();
}

async function exportFile({ app, plan, say }) {
  await plan.saved();
  download("/api/plan.toml", `${app.name}-missions.toml`)
    .catch((error) => say(error.message, { bad: true }));
}

const STEPS = [
  ["Add a mission", "Give it a name. Add as many as you like: they fly side by side, as far as there "
    + "are drones."],
  ["Set its trips", "Drag actions from the list onto the map, in the order of the trips. Pins can be "
    + "dragged to another place."],
  ["Press Start", "Watch it on the page Monitor. The two Stop buttons act at once. Missions that you "
    + "add meanwhile are started by pressing Start again."],
].map(([title, text], i) => [`${i + 1}. ${title}`, text]);

const welcome = (buttons, help) => h("section", { class: "card welcome stack" },
  h("h2", {}, "Nothing is planned yet"),
  h("p", { class: "muted" }, "A mission is a series of trips: a drone flies to a place, and does "
    + "something there. Three steps, and it flies:"),
  h("ol", { class: "welcome-steps" }, STEPS.map(([title, text]) =>
    h("li", {}, h("h3", {}, title), h("p", { class: "muted" }, text)))),
  h("div", { class: "row" }, buttons), help);

export function missions(context) {
  const { plan, selected, say, go } = context;

  const made = (change) => {
    const key = newKey();
    plan.edit(change(key));
    selected.set(key);
    panel.rename();
  };
  const add = () => made(addMission);
  const copy = (key) => made((fresh) => copyMission(key, fresh));
  const open = (key) => {
    selected.set(key);
    go("trips");
  };
  const place = (key) => plan.missions.findIndex((mission) => mission.key === key);
  const chosen = (mission) => {
    selected.set(mission?.key ?? null);
    list.element.focus();
  };

  function remove(key) {
    const at = place(key);
    const mission = plan.missions[at];
    if (mission.launched) return;
    plan.edit(deleteMission(key));
    chosen(plan.missions[at] ?? plan.missions.at(-1));
    say(`${mission.name} is deleted.`, {
      undo() {
        plan.edit(putBack(mission, at));
        chosen(mission);
      },
    });
  }

  function move(key, to) {
    plan.edit((all) => moved(all, key, to));
    context.hush(`${selected.mission()?.name} is number ${place(key) + 1} now.`);
  }

  const list = missionList({
    fields: context.app.fields, select: selected.set, open, rename: () => panel.rename(), remove, move,
  });
  const panel = missionPanel(context, { open, copy, remove });
  const none = h("section", { class: "card nothing-selected stack" },
    h("h2", {}, "No mission is selected"),
    h("p", {}, "Select a mission in the list first, or add one. Here you then give it a name and "
      + "set its trips."),
    h("p", { class: "hint" }, "A double-click on a mission opens its trips."));
  const first = welcome([
    button("Add the first mission", add, "primary", "plus"),
    button("Use the example plan", () => example(context)),
    button("Import a missions file", () => importFile(context)),
  ], h("p", { class: "hint" }, "More is on the page ", h("a", { href: "#help" }, "Help"), "."));
  const split = h("div", { class: "missions-split" },
    h("section", { class: "card mission-side", "aria-label": "All missions" },
      h("div", { class: "row" }, h("h2", {}, "Missions"), h("span", { class: "spread" },
        button("Add mission", add, "primary", "plus"))),
      list.element,
      h("p", { class: "hint" }, "Select one to fill it in. To move it, drag it or press ",
        h("kbd", { class: "key" }, "Alt ↑"), " ", h("kbd", { class: "key" }, "Alt ↓"), "."),
      h("div", { class: "row" }, button("Import file", () => importFile(context), "small"),
        button("Export file", () => exportFile(context), "small"))),
    h("div", {}, panel.element, none));

  function draw() {
    const all = plan.missions;
    const mission = selected.mission();
    shown(first, plan.loaded && !all.length);
    shown(split, all.length);
    shown(panel.element, mission);
    shown(none, !mission);
    list.update(all, mission && mission.key, plan.problems);
    if (mission) panel.update(mission, plan.problems);
  }

  plan.changed.heard(draw);
  selected.changed.heard(draw);
  return { element: h("div", {}, first, split), show: draw, lead: ({ field }) => panel.lead(field) };
}

const part = (title, rows, hint) => h("section", { class: "card stack" }, h("h2", {}, title),
  h("dl", {}, rows.filter(Boolean).map(([term, text]) =>
    [h("dt", {}, term), h("dd", {}, text)])),
  hint && h("p", { class: "hint" }, hint));

const keys = (...names) => names.map((name) => [h("kbd", { class: "key" }, name), " "]);

export const help = () => ({
  element: h("div", { class: "help" },
    part("From a plan to a flight", STEPS, "Nothing flies before Start is pressed. When you close this page, the missions fly "
      + "on; all who open the station see the same."),
    part("Stopping", [
      ["Stop: fly home", "All drones fly back to where they started, and land there."],
      ["Stop: land now", "All drones land where they are, also after the other Stop."],
      ["Resume", "Every mission goes on where it was stopped."],
      ["Put away", "What was stopped is not flown any more. Its plan stays."],
    ], "Both Stops act at once, and keep trying when the connection is lost. The page Monitor "
      + "stops a single mission."),
    part("Keys", [
      [keys("←", "→"), "On the tabs: another page"],
      [keys("↑", "↓"), "In the list of missions: select another"],
      [keys("Alt ↑", "Alt ↓"), "Move the mission or trip up or down in its list"],
      [keys("Enter", "F2"), "In the list of missions: set the trips, change the name"],
      [keys("Delete"), "Delete the mission or trip; Undo brings it back"],
      [keys("←", "↑", "→", "↓"), "On a pin: move it by 0.1 m, with Shift by 1 m. On the map: move "
        + "the view"],
    ]),
    token() && h("section", { class: "card stack" }, h("h2", {}, "This browser knows the token"),
      h("p", {}, "Every user of it can command this station."),
      h("div", {}, button("Forget the token", () => {
        forgetToken();
        location.reload();
      })))),
});

// Trips: pins and cards show one list, in which a pin is already where it is being dragged.

const PICK = "pick_item";
const RELEASE = "release_item";
const MASS = { name: "mass", type: "mass", units: ["g", "mg", "kg"] };
const nameOf = ({ name }) => name.trim() || "Without a name";
const problemLine = (text) =>
  h("p", { class: "problem" }, icon("warning"), h("span", {}, text));

export function trips(context) {
  const { app, plan, selected } = context;
  let chosen = null; // the key of a trip
  let draft = null; // { key, target }: a pin while it is dragged
  let fresh = null; // { words, target }: where an action would be put now
  let asked = 0;
  let told = "";

  const floor = floorPlan(app.map, app.drones);
  function choose(key) {
    if (key === chosen) return;
    chosen = key;
    const trip = selected.mission()?.trips.find((one) => one.key === key);
    if (trip?.target) floor.reveal(...trip.target);
    draw();
  }
  const act = { ...tripActs(context, choose, (key) => cards.focus(key)), choose };
  const palette = actions(app, floor, {
    add: act.add,
    hover(action, target) {
      fresh = target && { target, words: `${metres(target)} m` };
      draw();
    },
  });
  const cards = tripCards(app, act);
  const shownPins = pins(floor, {
    ...act,
    drag(key, target) {
      draft = target && { key, target };
      draw();
    },
    place(key, target) {
      draft = null;
      act.place(key, target);
    },
    open: cards.fillIn,
  });

  const newMission = (kind) => button("New mission", () => {
    const key = newKey();
    plan.edit(addMission(key));
    selected.set(key);
  }, kind, "plus");
  const id = unique("mission");
  const picker = h("select", {
    id, class: "input", onchange: () => selected.set(picker.value || null),
  });
  const tick = h("input", { type: "checkbox", onchange: () => draw() });
  const others = h("label", { class: "check spread" }, tick, "Show other missions");
  const bar = h("div", { class: "row mission-bar" }, h("label", { for: id }, "Mission"), picker,
    newMission(""), others);

  const title = h("h2");
  const why = h("p", { class: "hint" }, icon("lock"), " This mission has been started, so its "
    + "trips stay as they are. On the page Monitor you can skip a trip, or pause or cancel it.");
  const troubles = h("div");
  const hint = h("p", { class: "hint" });
  const side = h("section", { class: "card trips-side", "aria-label": "Trips of the mission" },
    title, why, troubles, cards.element, hint);
  const first = h("section", { class: "card stack trips-first", "aria-label": "What to do first" });
  const element = h("div", { class: "trips" }, bar, h("div", { class: "trips-split" },
    h("div", { class: "trips-main" }, palette.element,
      h("div", { class: "trips-floor" }, floor.element)), first, side));

  function aboutOf(kept, at, mission, from) {
    const dragged = draft?.key === kept.key && draft.target;
    const target = dragged ? [...dragged, ...kept.target.slice(2)] : kept.target;
    const pick = from.get(kept.key);
    const problems = plan.problems.filter(({ trip, field }) => trip === kept.key
      && !(dragged && field === "target")
      && !(pick !== undefined && field?.startsWith("item."))); // the trip that picks it tells that
    const here = dragged && whyNot(app.map, dragged);
    if (here) problems.unshift({ field: "target", text: here });
    const words = dragged ? here || `${metres(dragged)} m`
      : [called(kept.action), ...(kept.name ? [kept.name] : [])].join(" · ");
    return {
      key: kept.key, trip: kept, number: at + 1, target, words, problems,
      trouble: problems[0]?.text ?? "", pickedIn: pick === undefined ? null : pick + 1,
    };
  }

  function now() {
    asked = 0;
    const mission = selected.mission();
    const locked = !mission || mission.launched;
    const from = picks(mission?.trips ?? []);
    const list = (mission?.trips ?? []).map((trip, at) => aboutOf(trip, at, mission, from));
    if (!list.some(({ key }) => key === chosen)) chosen = null;
    showPins(list, mission, locked);
    shown(bar, plan.missions.length);
    shown(others, plan.missions.length > 1);
    const choices = plan.missions.map((one) =>
      [one.key, `${nameOf(one)} (${many(one.trips.length, "trip")})`]);
    if (told !== JSON.stringify([choices, !mission])) { // else a list that is open would close
      told = JSON.stringify([choices, !mission]);
      fill(picker, h("option", { value: "", hidden: mission }, "Choose a mission"),
        choices.map(([value, text]) => h("option", { value }, text)));
      fill(first, mission ? [] : whatFirst());
    }
    picker.value = mission?.key ?? "";
    shown(first, plan.loaded && !mission);
    shown(side, mission);
    shown(palette.element, !locked);
    if (locked && fresh) palette.putBack();
    if (!mission) return;
    put(title, `Trips of ${nameOf(mission)}`);
    shown(why, mission.launched);
    fill(troubles, list.length > 0 && plan.problems.filter(({ mission: key, trip, field }) =>
      key === mission.key && !trip && field !== "name").map(({ text }) => problemLine(text)));
    put(hint, locked || chosen ? "" : !list.length
      ? "No trips yet. Drag an action onto the map: that makes a trip."
      : "Drag a card, or press Alt with ↑ or ↓, to change the order. The line on the map shows "
        + "it; drones find their own way around no-fly areas.");
    cards.update(list, chosen, locked);
  }

  function showPins(list, mission, locked) {
    const start = list.find(({ target }) => target)?.target;
    const far = ({ home: [x, y] }) => Math.hypot(x - start[0], y - start[1]);
    const nearest = start && app.drones.toSorted((a, b) => far(a) - far(b))[0];
    const trouble = fresh && whyNot(app.map, fresh.target);
    const more = fresh
      ? [{ ...fresh, key: "new", number: "+", trouble, words: trouble || fresh.words }] : [];
    shownPins.update({ trips: [...list, ...more], chosen, locked, home: nearest?.home });
    const faint = mission && !tick.checked ? [] : plan.missions.filter((one) => one !== mission);
    shownPins.showOthers(faint.flatMap((one) => one.trips.map(({ name, target }, at) =>
      [`${nameOf(one)}, trip ${name ?? at + 1}`, target])).filter(([, target]) => target));
  }

  const whatFirst = () => plan.missions.length ? [
    h("h2", {}, "First choose a mission"),
    h("p", {}, "Trips belong to a mission. Whose trips do you want to set?"),
    plan.missions.slice(0, 8).map((one) => button(nameOf(one), () => selected.set(one.key))),
  ] : [
    h("h2", {}, "First make a mission"),
    h("p", {}, "A mission is a list of trips; a trip is a flight to a place, and what is done "
      + "there. Make a mission, then drag actions onto the map."),
    newMission("primary"),
  ];

  function draw() {
    asked ||= requestAnimationFrame(now);
  }
  plan.changed.heard(draw);
  selected.changed.heard(() => {
    chosen = draft = null;
    draw();
  });
  now();
  return {
    element, show: draw,
    lead({ trip, field }) {
      choose(trip);
      requestAnimationFrame(() => {
        if (trip) cards.fillIn(trip, field);
        else palette.element.querySelector(".action").focus();
      });
    },
  };
}

// For the key of each release, the place in the list of the pick whose item it puts down.
function picks(trips) {
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

function tripActs({ plan, selected, say, hush }, choose, focus) {
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
      const trips = mission()?.trips;
      if (!trips) return;
      const count = trips.filter((trip) => trip.action === PICK).length;
      // how heavy an item is, only people know
      const item = action.item ? { name: count ? `item ${count + 1}` : "item" } : null;
      const trip = { key: newKey(), action: action.name, target, parameters: {}, item };
      put(trip, trips.length);
      choose(trip.key);
      hush(`Trip ${trips.length + 1}, ${called(action.name)}, is on the map.`);
    },
    set: (key, name, value, typing) => inTrip(key, (trip) => withField(trip, name, value), typing),
    setIn: (key, part, name, value, typing) => inTrip(key, (trip) =>
      ({ ...trip, [part]: withField(trip[part] ?? {}, name, value) }), typing),
    // other pages may be writing the others
    setAxis: (key, axis, value, typing) => inTrip(key, (trip) => {
      const target = [...(trip.target ?? [0, 0])];
      target[axis] = value;
      if (value === undefined) target.pop();
      return { ...trip, target };
    }, typing),
    draft: (key, name, draft) => plan.draft(mission().key, key, name, draft),
    place(key, target) {
      for (const name of ["x", "y"]) plan.draft(mission().key, key, name);
      inTrip(key, (trip) => ({ ...trip, target: [...target, ...trip.target.slice(2)] }), true);
      hush(`${target.join(", ")} metres.`);
    },
    move(key, to) {
      if (to < 0 || to >= mission().trips.length) return;
      edit((trips) => moved(trips, key, to));
      hush(`It is trip ${to + 1} now.`);
    },
    copy(key) {
      const { name: _, ...trip } = mission().trips[at(key)] ?? {}; // no two trips have one name
      if (!trip.key) return;
      const fresh = { ...trip, key: newKey() };
      put(fresh, at(key) + 1);
      choose(fresh.key);
    },
    remove(key) {
      const where = mission();
      const index = at(key);
      const trip = where.trips[index];
      if (!trip) return; // another page was faster
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

function tripCards(app, act) {
  const element = h("ol", { class: "trip-cards", "aria-label": "Trips, in their order" });
  const parts = new WeakMap();
  let shownTrips = [];
  let isLocked = false;
  let opened = null;

  reorderable(element, (from, to) => !isLocked && act.move(shownTrips[from].key, to));
  const shift = (key, by) => act.move(key, shownTrips.findIndex((trip) => trip.key === key) + by);

  function make({ key, trip }) {
    const id = unique("trip");
    const [number, words, where, sign] = ["number", "words", "hint", "sign"].map((name) =>
      h("span", { class: name }));
    const head = h("button", {
      class: "trip-head", "aria-controls": id,
      onclick: () => act.choose(key === opened ? null : key),
      onkeydown: (event) => event.key === "Delete" && !isLocked && act.remove(key),
    }, number, actionSign(trip.action), h("span", { class: "what" }, words, " ", where), sign);
    const body = h("div", { id });
    const card = h("li", {
      class: "trip-card", "data-key": key,
      onkeydown(event) {
        const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
        if (!event.altKey || !by || isLocked) return;
        event.preventDefault();
        shift(key, by);
      },
    }, h("div", { class: "trip-line" }, h("span", { class: "grip" }, icon("grip")), head), body);
    parts.set(card, { number, words, where, sign, head, body, fields: null });
    return card;
  }

  // about: { key, trip, number, words, problems, trouble, pickedIn }
  function show(card, about) {
    const part = parts.get(card);
    const isOpen = about.key === opened;
    put(part.number, about.number);
    put(part.words, about.words);
    put(part.where, about.target ? `${metres(about.target)} m` : "no place yet");
    fill(part.sign, about.trouble && h("span", { class: "chip warn" }, icon("warning"), "To mend"));
    set(part.head, "aria-expanded", String(isOpen));
    card.classList.toggle("chosen", isOpen);
    if (!isOpen) {
      part.fields = fill(part.body) && null;
      return;
    }
    part.fields ??= tripFields(app, about, act, shift);
    if (!part.body.firstChild) part.body.append(part.fields.element);
    part.fields.update(about, isLocked, shownTrips);
  }

  const cardOf = (key) => element.querySelector(`[data-key="${key}"]`);

  return {
    element,
    update(trips, chosen, locked) {
      const isOther = chosen !== opened;
      [shownTrips, opened, isLocked] = [trips, chosen, locked];
      element.classList.toggle("locked", locked);
      keyed(element, trips, ({ key }) => key, make, show);
      const card = chosen && cardOf(chosen);
      // the list may be scrolled, but never the page: the map stays where it is
      if (isOther && card && element.scrollHeight > element.clientHeight) {
        card.scrollIntoView({ block: "nearest" });
      }
    },
    focus: (key) => cardOf(key)?.querySelector(".trip-head").focus(),
    fillIn: (key, field) => parts.get(cardOf(key))?.fields?.focus(field),
  };
}

function tripFields(app, { key, trip: { action } }, act, shift) {
  const { parameters = [], item } = app.actions.find(({ name }) => name === action) ?? {};
  const fields = [];
  const field = (spec, about, value, change) => {
    const one = fieldFor(spec, { evaluators: app.evaluators, change });
    fields.push({ one, about, value });
    return one;
  };
  const [x, y] = ["x (m)", "y (m)", "Height (m)"].map((label, axis) => {
    const usual = axis === 2 ? app.map.cruise_height : null;
    const about = "xyz"[axis];
    const spec = {
      name: about, label, type: "float", default: usual,
      wrong: (value) => typeof value === "number" || (axis === 2 && value === undefined) ? ""
        : "Write metres here, such as 2.5.",
    };
    return field(spec, about, (trip) => trip.target?.[axis], (value, typing, draft) => {
      act.draft(key, about, draft && { ...draft, now: (trip) => trip.target?.[axis] ?? usual });
      if (!draft) act.setAxis(key, axis, value, typing);
    });
  });
  const inside = (part, spec, name) => field(spec, `${part}.${name}`, (trip) => trip[part]?.[name],
    (value, typing) => act.setIn(key, part, name, value, typing));
  const own = (spec) => field(spec, spec.name, (trip) => trip[spec.name],
    (value, typing) => act.set(key, spec.name, value, typing));
  const name = own({ name: "name", type: "text" });
  const releases = action === RELEASE;
  if (item && !releases) {
    inside("item", { name: "item", type: "text" }, "name");
    inside("item", MASS, "mass");
  }
  for (const parameter of parameters) inside("parameters", parameter, parameter.name);
  ownFirst(app.fields.trip).forEach(own);
  const known = fields.map(({ about }) => about);
  const troubles = h("div", { class: "wide" });
  const carried = h("p", { class: "wide hint carried" });
  const up = button("Earlier", () => shift(key, -1), "small");
  const down = button("Later", () => shift(key, 1), "small");
  const foot = h("div", { class: "row wide" }, up, down,
    button("Copy", () => act.copy(key), "small"), button("Delete", () => act.remove(key), "small"));

  return {
    element: h("div", { class: "trip-body" }, troubles, releases && carried,
      fields.map(({ one }) => one.element), foot),
    focus: (where) =>
      (fields.find(({ about }) => about === where) ?? fields[0]).one.input.focus(),
    update({ trip, target, number, problems, pickedIn }, locked, all) {
      for (const { one, about: where, value } of fields) {
        const own = problems.filter(({ field }) => field === where);
        one.update(own[0]?.typed ?? value({ ...trip, target }),
          { problem: own.map(({ text }) => text).join(" "), locked });
      }
      name.input.placeholder = number;
      if (problems.some(({ field }) => field === "target")) {
        for (const { input } of [x, y]) set(input, "aria-invalid", "true");
      }
      fill(troubles, problems.filter((one) => !known.includes(one.field))
        .map(({ text }) => problemLine(text)));
      const mass = trip.item?.mass ? ` (${trip.item.mass})` : "";
      put(carried, pickedIn
        ? `Puts down “${trip.item?.name ?? ""}”${mass}, which trip ${pickedIn} picks.`
        : "Put a trip with “Pick item” before this one: then this one knows its item.");
      shown(foot, !locked);
      up.disabled = number === 1;
      down.disabled = number === all.length;
    },
  };
}
