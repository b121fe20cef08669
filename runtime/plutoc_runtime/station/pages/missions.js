// The page Missions: the list on the left, the selected mission beside it. Nothing asks before it
// acts; what was deleted can be brought back.

import { h, shown } from "./dom.js";
import { icon } from "./icons.js";
import { missionList } from "./mission_list.js";
import { missionPanel } from "./mission_panel.js";
import { addMission, copyMission, deleteMission, moveMission, putBack } from "./plan_edits.js";
import { example, exportFile, importFile } from "./plan_files.js";
import { welcome } from "./welcome.js";
import { newKey } from "./words.js";

function nothingSelected() {
  return h("section", { class: "card nothing-selected stack", "aria-labelledby": "none-selected" },
    h("h2", { id: "none-selected" }, "No mission is selected"),
    h("p", {}, "Select a mission in the list first, or add one. ",
      "Here you then give it a name and set its trips."),
    h("p", { class: "hint" }, "A double-click on a mission opens its trips."));
}

const key = (text) => h("kbd", { class: "key" }, text);

function small(sign, text, onclick) {
  return h("button", { class: "button small", onclick }, icon(sign), text);
}

export function missions(context) {
  const { app, plan, selected, say } = context;

  function made(change, key) {
    plan.edit(change);
    selected.set(key);
    panel.rename();
  }

  function add() {
    const key = newKey();
    made(addMission(key), key);
  }

  function copy(key) {
    const fresh = newKey();
    made(copyMission(key, fresh), fresh);
  }

  function remove(key) {
    const at = plan.missions.findIndex((mission) => mission.key === key);
    const mission = plan.missions[at];
    if (!mission || mission.launched) return;
    plan.edit(deleteMission(key));
    const next = plan.missions[Math.min(at, plan.missions.length - 1)];
    selected.set(next?.key ?? null);
    if (next) list.focus();
    say(`${mission.name} is deleted.`, {
      undo() {
        plan.edit(putBack(mission, at));
        selected.set(key);
        list.focus();
      },
    });
  }

  function move(key, to) {
    plan.edit(moveMission(key, to));
    const at = plan.missions.findIndex((mission) => mission.key === key);
    context.hush(`${plan.missions[at]?.name} is number ${at + 1} now.`);
  }

  function open(key) {
    selected.set(key);
    context.go("trips");
  }

  const list = missionList(app.fields.mission, {
    select: selected.set, open, rename: () => panel.rename(), remove, move,
  });
  const step = (key, by) =>
    move(key, plan.missions.findIndex((mission) => mission.key === key) + by);
  const panel = missionPanel(context, { open, copy, remove, move: step });
  const none = nothingSelected();
  const first = welcome(context, {
    add, example: () => example(context), read: () => importFile(context),
  });
  const split = h("div", { class: "missions-split" },
    h("section", { class: "card mission-side", "aria-label": "All missions" },
      h("div", { class: "row" }, h("h2", {}, "Missions"), h("button", {
        class: "button primary spread", onclick: add,
      }, icon("plus"), "Add mission")),
      list.element,
      h("p", { class: "hint" }, "Select one to fill it in. To move it, drag it or press ",
        key("Alt ↑"), " ", key("Alt ↓"), "."),
      h("div", { class: "row side-foot" },
        small("import", "Import file", () => importFile(context)),
        small("export", "Export file", () => exportFile(context)))),
    h("div", { class: "mission-main" }, panel.element, none));
  const element = h("div", {}, first, split);

  function draw() {
    const { missions: all, problems } = plan;
    const mission = selected.mission();
    shown(first, plan.loaded && !all.length);
    shown(split, all.length > 0);
    shown(panel.element, mission);
    shown(none, !mission);
    list.update(all, mission ? mission.key : null, problems);
    if (mission) panel.update(mission, problems, all.indexOf(mission), all.length);
  }

  plan.changed.heard(draw);
  selected.changed.heard(draw);
  draw();
  return { element, show: draw };
}
