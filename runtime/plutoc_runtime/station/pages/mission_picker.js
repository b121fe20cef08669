// Whose trips these are: the missions to choose from, above the map.

import { fill, h, unique } from "./dom.js";
import { icon } from "./dom.js";
import { addMission } from "./plan.js";
import { many, newKey } from "./dom.js";

export function newMission({ plan, selected }) {
  const key = newKey();
  plan.edit(addMission(key));
  selected.set(key);
}

export function missionPicker(context, { others }) {
  const { plan, selected } = context;
  const id = unique("mission");
  const select = h("select", { id, class: "input", onchange: () => selected.set(select.value || null) });
  const tick = h("input", { type: "checkbox", onchange: others });
  const show = h("label", { class: "check" }, tick, "Show other missions");
  const add = h("button", { type: "button", class: "button", onclick: () => newMission(context) },
    icon("plus"), "New mission");
  const element = h("div", { class: "row mission-picker" },
    h("label", { for: id }, "Mission"), select, add, h("span", { class: "spread" }, show));
  let told = "";

  return {
    element,
    othersShown: () => tick.checked,
    update() {
      const list = plan.missions.map(({ key, name, trips }) =>
        [key, `${name.trim() || "Without a name"} (${many(trips.length, "trip")})`]);
      const now = JSON.stringify(list);
      if (now !== told) {
        told = now;
        fill(select, h("option", { value: "" }, "Choose a mission"),
          list.map(([value, text]) => h("option", { value }, text)));
      }
      select.value = selected.mission()?.key ?? "";
      select.options[0].hidden = Boolean(select.value);
      element.hidden = !list.length;
      show.hidden = list.length < 2;
    },
  };
}
