// The page Missions: the list, the selected mission beside it, and what to do first. Nothing asks
// before it acts; what was deleted can be brought back. And the page Help.

import {
  addMission, copyMission, deleteMission, download, moved, putBack, send, setField,
} from "./api.js";
import {
  button, fieldFor, fill, h, icon, keyed, many, newKey, plain, put, reorderable, set, shown, unique,
} from "./dom.js";

// The missions in their order, one of them selected.
function missionList({ select, open, rename, remove, move }) {
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
  function mark({ key, trips, launched }, problems) {
    const of = problems.filter(({ mission }) => mission === key);
    if (launched) return ["Started", "info", "lock"];
    if (of.some(({ field }) => trips.length || field)) return ["To mend", "warn", "warning"];
    return of.length ? ["To do", ""] : [];
  }

  function update(node, mission, i, problems) {
    const [, count, words, chip] = node.children;
    put(count, i + 1);
    put(words.firstChild, mission.name.trim() || "Without a name");
    put(words.lastChild, mission.trips.length ? many(mission.trips.length, "trip")
      : "no trips yet");
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

// The selected mission: its name, the fields that the app's graph needs, its trips in short.
function missionPanel({ app, plan }, { open, copy, remove }) {
  let now = null;
  const inputs = [{ name: "name", type: "text" }, ...app.fields.mission].map((field) =>
    [field.name, fieldFor(field, {
      evaluators: app.evaluators,
      change: (value, typing) => now
        && plan.edit(setField(now.key, field.name, value ?? (field.name === "name" ? "" : value)),
          typing),
    })]);
  const [[, title], ...others] = inputs;
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
  return {
    element: h("section", { class: "card mission-panel stack", "aria-label": "Selected mission" },
      locked, title.element, said,
      others.length > 0 && h("div", { class: "fields" }, others.map(([, input]) => input.element)),
      h("div", { class: "row" }, count, h("span", { class: "spread" }, trips)), short,
      h("div", { class: "row" }, button("Copy", () => copy(now.key)), bin)),
    rename() {
      title.input.focus();
      title.input.select();
    },
    update(mission, problems) {
      if (now?.key !== mission.key) title.input.blur();
      now = mission;
      const of = problems.filter((problem) => problem.mission === mission.key);
      for (const [name, input] of inputs) {
        const problem = of.find(({ trip, field }) => !trip && field === name)?.text;
        input.update(mission[name], { problem, locked: mission.launched });
      }
      const told = of.filter(({ trip, field }) =>
        mission.trips.length && (trip || !inputs.some(([name]) => name === field)));
      fill(said, told.slice(0, 5).map(({ trip, text }) => {
        const at = mission.trips.findIndex(({ key }) => key === trip) + 1;
        return h("p", { class: "problem" }, icon("warning"), at ? `Trip ${at}: ${text}` : text);
      }));
      put(count, mission.trips.length ? many(mission.trips.length, "trip") : "Trips");
      put(trips.lastChild, mission.launched ? "See trips" : "Set trips");
      put(short, mission.trips.slice(0, 20).map(({ action }) => plain(action)).join(", ")
        || "No trips yet. “Set trips” opens the map: drag actions onto it there.");
      shown(locked, mission.launched);
      bin.disabled = mission.launched;
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
    if (status === 409) throw new Error("Somebody else changed the plan meanwhile: try again.");
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

// What one sees first, where the plan is still empty.
const welcome = (buttons, help) => h("section", { class: "card welcome stack" },
  h("h2", {}, "Nothing is planned yet"),
  h("p", { class: "muted" }, "A mission is a series of trips: a drone flies to a place, and does "
    + "something there. Three steps, and it flies:"),
  h("ol", { class: "welcome-steps" }, [
    ["Add a mission", "Give it a name. Add as many as you like: they fly side by side, as "
      + "far as there are drones."],
    ["Set its trips", "Drag actions from the list onto the map, in the order of the trips."],
    ["Press Start", "Watch it on the page Monitor. The two Stop buttons act at once."],
  ].map(([title, text], i) =>
    h("li", {}, h("h3", {}, `${i + 1}. ${title}`), h("p", { class: "muted" }, text)))),
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
    select: selected.set, open, rename: () => panel.rename(), remove, move,
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
  return { element: h("div", {}, first, split), show: draw };
}

const part = (title, rows, hint) => h("section", { class: "card stack" }, h("h2", {}, title),
  h("dl", {}, rows.filter(Boolean).map(([term, text]) =>
    [h("dt", {}, term), h("dd", {}, text)])),
  hint && h("p", { class: "hint" }, hint));

const keys = (...names) => names.map((name) => [h("kbd", { class: "key" }, name), " "]);

export const help = () => ({
  element: h("div", { class: "help" },
    part("From a plan to a flight", [
      ["1. Missions", "Add a mission and give it a name. Missions fly side by side, as far as "
        + "there are drones."],
      ["2. Trips", "Drag actions onto the map, in the order in which they are to be done. Pins can "
        + "be dragged to another place."],
      ["3. Start", "The page Monitor shows each mission, each drone, and what was measured and "
        + "photographed. Missions that you add meanwhile are started by pressing Start again."],
    ], "Nothing flies before somebody presses Start. When you close this page, the missions fly "
      + "on; whoever opens the station sees the same."),
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
    ])),
});
