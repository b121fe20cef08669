// What to do first where no mission is selected: trips always belong to one.

import { fill, h, shown } from "./dom.js";
import { icon } from "./dom.js";
import { newMission } from "./mission_picker.js";
import { many } from "./dom.js";

const SHOWN = 8; // missions

export function nothingToSet(context) {
  const { plan, selected, go } = context;
  const list = h("div", { class: "hint-missions" });
  const title = h("h2", {});
  const words = h("p", {});
  const add = h("button", { type: "button", class: "button primary", onclick: () => newMission(context) },
    icon("plus"), "New mission");
  const element = h("section", { class: "card stack trips-first", "aria-label": "What to do first" },
    title, words, list, h("div", { class: "row" }, add,
      h("button", { type: "button", class: "button quiet", onclick: () => go("missions") },
        "To the page Missions")));

  return {
    element,
    update() {
      const { missions } = plan;
      shown(element, plan.loaded && !selected.mission());
      shown(list, missions.length);
      if (selected.mission()) return;
      fill(title, missions.length ? "First choose a mission" : "First make a mission");
      fill(words, missions.length
        ? "Trips belong to a mission. Whose trips do you want to set?"
        : "A mission is a list of trips; a trip is a flight to a place, and what is done there. "
          + "Make a mission, then drag actions onto the map.");
      fill(list, missions.slice(0, SHOWN).map(({ key, name, trips }) =>
        h("button", { type: "button", class: "button", onclick: () => selected.set(key) },
          name.trim() || "Without a name",
          h("span", { class: "hint" }, many(trips.length, "trip")))),
      missions.length > SHOWN && h("p", { class: "hint" },
        `and ${missions.length - SHOWN} more in the list above`));
    },
  };
}
