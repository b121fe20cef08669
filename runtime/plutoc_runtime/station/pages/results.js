// What the missions brought: measurements, photos and, where the app judges, verdicts.
import { h } from "./dom.js";
import { fetched } from "./fetched.js";
import { measurements } from "./measurements.js";
import { photos } from "./photos.js";
import { words } from "./quick.js";
import { verdicts } from "./verdicts.js";

export function resultsView(context, app, floor, chosen) {
  const save = h("button", { type: "button", class: "button quiet small" }, "Download");
  save.addEventListener("click", () => fetched(context, "/api/results.json", "results.json"));
  const parts = [
    { kind: "value", label: "Measurements", view: measurements(chosen) },
    { kind: "photo", label: "Photos", view: photos(app.map, floor, chosen) },
  ];
  if (app.evaluators.length) {
    parts.push({ kind: "verdict", label: "Verdicts", view: verdicts(chosen) });
  }
  const list = h("div", { class: "sifts", role: "group", "aria-label": "Which results" });
  const inside = h("div", { class: "results-body" });
  let picked = false; // by a person
  for (const part of parts) {
    part.count = words("0");
    part.number = 0;
    const count = h("span", { class: "m-count" }, part.count.node);
    part.button = h("button", { type: "button", class: "sift" }, `${part.label} `, count);
    part.button.addEventListener("click", () => {
      picked = true;
      open(part);
    });
    list.append(part.button);
    inside.append(part.view.element);
  }
  const open = (part) => {
    for (const each of parts) {
      each.button.setAttribute("aria-pressed", String(each === part));
      each.view.element.hidden = each !== part;
    }
  };
  open(parts[0]);

  const update = (entries) => {
    for (const part of parts) {
      const own = entries.filter((entry) => entry[7] === part.kind);
      if (!own.length) continue;
      const first = part.number === 0;
      part.number += own.length;
      part.count.show(String(part.number));
      part.view.update(own);
      // What there is first is shown first, until somebody chooses.
      if (first && !picked && parts.every((each) => each === part || !each.number)) open(part);
    }
  };
  const clear = () => {
    for (const part of parts) {
      part.number = 0;
      part.count.show("0");
      part.view.clear();
    }
  };
  return { element: inside, tools: h("div", { class: "filters" }, list, save), update, clear };
}
