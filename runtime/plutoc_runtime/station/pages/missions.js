// The page Missions: the list, the selected mission beside it, and what to do first. Nothing asks
// before it acts; what was deleted can be brought back.

import { download, send } from "./api.js";
import { fill, h, icon, keyed, many, newKey, plain, put, set, shown, unique } from "./dom.js";
import { fieldFor, inWords, TIME } from "./fields.js";
import { addMission, copyMission, deleteMission, moved, putBack, setField } from "./plan.js";
import { reorderable } from "./reorder.js";

const SHOWN = 12; // trips in short

const button = (sign, text, onclick, kind = "") =>
  h("button", { class: `button ${kind}`, onclick }, icon(sign), h("span", {}, text));
const arrow = (sign, text, onclick) =>
  h("button", { class: "button icon", "aria-label": text, title: text, onclick }, icon(sign));
const number = () => h("span", { class: "mission-number num" });

// The missions in their order, one of them selected.
function missionList(fields, { select, open, rename, remove, move }) {
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
    h("span", { class: "grip" }, icon("grip")), number(),
    h("span", { class: "mission-words" }, h("strong"), h("span", { class: "hint" })),
    h("span", { class: "chip" }));

  // A mission that is only not finished yet has nothing wrong with it.
  function mark({ key, trips, launched }, problems) {
    const of = problems.filter(({ mission }) => mission === key);
    if (launched) return ["Started", "info", "lock"];
    if (of.some(({ field }) => trips.length || field)) return ["To mend", "warn", "warning"];
    return of.length ? ["To do", ""] : [];
  }

  function update(node, mission, i, problems) {
    const [, count, words, chip] = node.children;
    const given = fields.filter(({ name }) => (mission[name] ?? null) !== null)
      .map(({ name, label, type }) => `${label.toLowerCase()} ${mission[name] === true
        ? "until stopped" : plain(inWords(mission[name], type === "time" ? TIME : []))}`);
    const trips = mission.trips.length ? many(mission.trips.length, "trip") : "no trips yet";
    put(count, i + 1);
    put(words.firstChild, mission.name.trim() || "Without a name");
    put(words.lastChild, [trips, ...given].join(" · "));
    const [text, kind, sign] = mark(mission, problems);
    if (chip.dataset.text !== text) {
      chip.dataset.text = text;
      set(chip, "class", `chip ${kind}`);
      fill(chip, sign && icon(sign), text);
    }
    shown(chip, text);
    const now = mission.key === selected;
    if (now && node.getAttribute("aria-selected") !== "true") {
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

// The selected mission: its name, the fields that the app's graph needs, its trips in short.
function missionPanel({ app, plan }, { open, copy, remove, step }) {
  let now = null;
  const inputs = [{ name: "name", type: "text" }, ...app.fields.mission].map((field) =>
    [field.name, fieldFor(field, {
      evaluators: app.evaluators,
      change: (value, typing) => now
        && plan.edit(setField(now.key, field.name, value ?? (field.name === "name" ? "" : value)),
          typing),
    })]);
  const [[, title], ...others] = inputs;
  const trips = button("map", "Set trips", () => open(now.key), "primary");
  title.element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    trips.focus();
  });
  const locked = h("p", { class: "row" }, icon("lock"),
    "It has been started: it can be changed again when it has ended.");
  const said = h("div", { class: "stack" });
  const count = h("h3");
  const list = h("ol", { class: "trips-short" });
  const more = h("p", { class: "hint" });
  const up = arrow("up", "Move up", () => step(now.key, -1));
  const down = arrow("down", "Move down", () => step(now.key, 1));
  const bin = button("bin", "Delete", () => remove(now.key));
  const wrong = (text) => text && h("span", { class: "problem" }, icon("warning"), text);

  function tripLine({ trip, i, text }) {
    const place = trip.target && ` at ${trip.target[0].toFixed(1)}, ${trip.target[1].toFixed(1)} m`;
    return h("li", {}, put(number(), i + 1), h("span", { class: "mission-words" },
      h("b", {}, trip.name ?? `Trip ${i + 1}`), " ",
      h("span", { class: "muted" }, plain(trip.action), place ?? " without a place yet"),
      wrong(text)));
  }

  return {
    element: h("section", { class: "card mission-panel stack", "aria-label": "Selected mission" },
      locked, title.element, said,
      others.length > 0 && h("div", { class: "fields" }, others.map(([, input]) => input.element)),
      h("div", { class: "row" }, count, h("span", { class: "spread" }, trips)), list, more,
      h("div", { class: "row" }, up, down, h("span", { class: "row spread" },
        button("copy", "Copy", () => copy(now.key)), bin))),
    rename() {
      title.input.focus();
      title.input.select();
    },
    update(mission, problems, index, total) {
      if (now?.key !== mission.key) title.input.blur();
      now = mission;
      const of = problems.filter((problem) => problem.mission === mission.key);
      for (const [name, input] of inputs) {
        const problem = of.find(({ trip, field }) => !trip && field === name)?.text;
        input.update(mission[name], { problem, locked: mission.launched });
      }
      const general = mission.trips.length > 0 && of.find(({ trip, field }) => !trip && !field);
      fill(said, wrong(general && general.text));
      put(count, mission.trips.length ? many(mission.trips.length, "trip") : "Trips");
      put(trips.lastChild, mission.launched ? "See trips" : "Set trips");
      const lines = mission.trips.slice(0, SHOWN).map((trip, i) =>
        ({ trip, i, text: of.find((problem) => problem.trip === trip.key)?.text }));
      keyed(list, lines, JSON.stringify, tripLine);
      put(more, !mission.trips.length
        ? "No trips yet. “Set trips” opens the map: drag actions onto it there."
        : mission.trips.length > SHOWN ? `and ${mission.trips.length - SHOWN} more` : "");
      shown(locked, mission.launched);
      up.disabled = index === 0;
      down.disabled = index === total - 1;
      bin.disabled = mission.launched;
    },
  };
}

// Takes away what came, and brings back what went; what was done since then stays.
function back(before, after) {
  const [was, came] = [before, after].map((list) => new Set(list.map(({ key }) => key)));
  return (missions) => [
    ...missions.filter(({ key }) => was.has(key) || !came.has(key)),
    ...before.filter(({ key }) => !came.has(key) && !missions.some((one) => one.key === key)),
  ];
}

// The station makes another plan of it; where somebody was quicker, on top of theirs.
async function another({ plan, say, selected }, ask, said) {
  await plan.saved();
  const before = plan.missions;
  try {
    let { status, data } = await ask(plan.revision());
    if (status === 409) ({ status, data } = await ask(data.revision));
    if (status === 409) throw new Error(data.said ?? "Somebody else changed the plan: try again.");
    plan.take(data);
  } catch (error) {
    say(error.message, { bad: true });
    return;
  }
  const after = plan.missions;
  selected.set(after.find(({ launched }) => !launched)?.key ?? null);
  say(said, { undo: () => plan.edit(back(before, after)) });
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
        send("POST", `/api/plan/import?revision=${revision}`, text, "application/toml"),
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

// What one sees first, where the plan is still empty.
const welcome = (buttons, help) => h("section", { class: "card welcome stack" },
  h("h2", {}, "Nothing is planned yet"),
  h("p", { class: "muted" }, "A mission is a series of trips: a drone flies to a place, and does "
    + "something there. Three steps, and it flies:"),
  h("ol", { class: "welcome-steps" }, [
    ["plus", "Add a mission", "Give it a name. Add as many as you like: they fly side by side, as "
      + "far as there are drones."],
    ["map", "Set its trips", "Drag actions from the list onto the map, in the order of the trips."],
    ["start", "Press Start", "Watch it on the page Monitor. The two Stop buttons act at once."],
  ].map(([sign, title, text], i) => h("li", {}, h("span", { class: "welcome-sign" }, icon(sign)),
    h("h3", {}, `${i + 1}. ${title}`), h("p", { class: "muted" }, text)))),
  h("div", { class: "row" }, buttons), help);

export function missions(context) {
  const { app, plan, selected, say, go } = context;

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

  const list = missionList(app.fields.mission, {
    select: selected.set, open, rename: () => panel.rename(), remove, move,
  });
  const panel = missionPanel(context, {
    open, copy, remove, step: (key, by) => move(key, place(key) + by),
  });
  const none = h("section", { class: "card nothing-selected stack" },
    h("h2", {}, "No mission is selected"),
    h("p", {}, "Select a mission in the list first, or add one. Here you then give it a name and "
      + "set its trips."),
    h("p", { class: "hint" }, "A double-click on a mission opens its trips."));
  const files = [["import", "Import file", importFile], ["export", "Export file", exportFile]]
    .map(([sign, text, act]) => button(sign, text, () => act(context), "small"));
  const first = welcome([
    button("plus", "Add the first mission", add, "primary"),
    h("button", { class: "button", onclick: () => example(context) }, "Use the example plan"),
    button("import", "Import a missions file", () => importFile(context)),
  ], h("p", { class: "hint" }, "More is on the page ", h("a", { href: "#help" }, "Help"), "."));
  const split = h("div", { class: "missions-split" },
    h("section", { class: "card mission-side", "aria-label": "All missions" },
      h("div", { class: "row" }, h("h2", {}, "Missions"), h("span", { class: "spread" },
        button("plus", "Add mission", add, "primary"))),
      list.element,
      h("p", { class: "hint" }, "Select one to fill it in. To move it, drag it or press ",
        h("kbd", { class: "key" }, "Alt ↑"), " ", h("kbd", { class: "key" }, "Alt ↓"), "."),
      h("div", { class: "row" }, files)),
    h("div", {}, panel.element, none));

  function draw() {
    const all = plan.missions;
    const mission = selected.mission();
    shown(first, plan.loaded && !all.length);
    shown(split, all.length);
    shown(panel.element, mission);
    shown(none, !mission);
    list.update(all, mission && mission.key, plan.problems);
    if (mission) panel.update(mission, plan.problems, all.indexOf(mission), all.length);
  }

  plan.changed.heard(draw);
  selected.changed.heard(draw);
  return { element: h("div", {}, first, split), show: draw };
}
