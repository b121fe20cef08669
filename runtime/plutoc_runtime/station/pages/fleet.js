// The drones as a list: how each stands, its battery, what it flew; take it out, bring it back.
import { h } from "./dom.js";
import { battery } from "./battery.js";
import { attribute, words } from "./quick.js";
import { sign, tone } from "./signs.js";
import { droneWord } from "./standing.js";
import { many } from "./dom.js";

function droneLine(context, id, category, chosen) {
  const [status, trips] = [words(), words()];
  const mark = sign();
  const charge = battery();
  const mission = h("button", { type: "button", class: "link" });
  const act = h("button", { type: "button", class: "button quiet small" });
  let row = null;
  mission.addEventListener("click", () => chosen.set(row.mission));
  act.addEventListener("click", () =>
    context.tell(row.retired ? "bring-back" : "retire", { drone: id }),
  );
  const state = h("span", { class: "m-status" }, mark.element, status.node);
  const element = h(
    "li",
    { class: "drone-line" },
    h("span", { class: "who" }, h("strong", {}, id), h("small", {}, category)),
    h("span", { class: "doing" }, state, mission),
    charge.element,
    h("span", { class: "flown" }, trips.node),
    act,
  );
  const write = {
    tone: attribute(state, "data-tone"),
    label: attribute(act, "aria-label"),
    chosen: attribute(element, "data-chosen"),
  };
  const show = (next) => {
    row = next;
    const standing = row.retired ? "RETIRED" : row.status;
    status.show(droneWord(row));
    mark.show(standing);
    write.tone(tone(standing));
    charge.show(row.battery);
    trips.show(many(row.trips, "trip"));
    if (mission.textContent !== (row.mission ?? "")) mission.textContent = row.mission ?? "";
    mission.hidden = !row.mission;
    const word = row.retired ? "Bring back" : "Retire";
    if (act.textContent !== word) act.textContent = word;
    write.label(`${word} drone ${id}`);
    highlight();
  };
  const highlight = () => write.chosen(row.mission && row.mission === chosen.get() ? "yes" : null);
  return { element, show, highlight };
}

export function fleetList(context, app, chosen) {
  const categories = new Map(app.drones.map((drone) => [drone.id, drone.category]));
  const several = app.categories.length > 1;
  const element = h("ul", { class: "drones-list" });
  const lines = new Map();
  const update = (drones) => {
    for (const drone of drones) {
      let line = lines.get(drone.id);
      if (!line) {
        const category = several ? categories.get(drone.id) ?? "" : "";
        line = droneLine(context, drone.id, category, chosen);
        lines.set(drone.id, line);
        element.append(line.element);
      }
      line.show(drone);
    }
  };
  const clear = () => {
    lines.clear();
    element.replaceChildren();
  };
  chosen.watch(() => {
    for (const line of lines.values()) line.highlight();
  });
  return { element, update, clear };
}
