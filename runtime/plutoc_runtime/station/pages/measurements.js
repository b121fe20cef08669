// What was measured: a line a mission with how it went, and below it every value, newest first.
import { h } from "./dom.js";
import { attribute, words } from "./quick.js";
import { sparkline } from "./sparkline.js";
import { clock } from "./dom.js";

const SHOWN = 200;

const written = (value) =>
  typeof value === "number" ? String(Number(value.toPrecision(4))) : String(value);

function missionLine(name, chosen) {
  const [newest, range, count] = [words("–"), words(), words()];
  const spark = sparkline();
  const pick = h("button", { type: "button", class: "link" }, name);
  pick.addEventListener("click", () => chosen.set(chosen.get() === name ? null : name));
  const element = h(
    "tr",
    {},
    h("th", { scope: "row" }, pick),
    h("td", { class: "num" }, newest.node),
    h("td", {}, spark.element),
    h("td", { class: "num range" }, range.node),
    h("td", { class: "num" }, count.node),
  );
  const picked = attribute(element, "data-chosen");
  const numbers = [];
  let all = 0;
  const add = (values) => {
    all += values.length;
    numbers.push(...values.filter((value) => typeof value === "number"));
    if (numbers.length > 2000) numbers.splice(0, numbers.length - 1000);
    newest.show(written(values.at(-1)));
    count.show(String(all));
    if (!numbers.length) return;
    spark.show(numbers);
    const [low, high] = [Math.min(...numbers), Math.max(...numbers)];
    range.show(low < high ? `${written(low)} to ${written(high)}` : "");
  };
  return { element, add, highlight: () => picked(chosen.get() === name ? "yes" : null) };
}

const entryRow = ([, time, mission, trip, round, , drone, , value]) =>
  h(
    "tr",
    { "data-mission": mission },
    h("td", { class: "num" }, clock(time)),
    h("td", {}, mission),
    h("td", {}, round > 1 ? `${trip}, round ${round}` : trip),
    h("td", { class: "num" }, written(value)),
    h("td", {}, drone ?? ""),
  );

const heads = (...names) =>
  h("thead", {}, h("tr", {}, ...names.map((name) => h("th", { scope: "col" }, name))));

export function measurements(chosen) {
  const lines = new Map();
  const body = h("tbody");
  const every = h("tbody");
  const empty = h("p", { class: "empty" }, "Nothing has been measured yet.");
  const summary = h(
    "table",
    { class: "table", "aria-label": "Measurements of each mission" },
    heads("Mission", "Newest", "How it went", "From … to", "Values"),
    body,
  );
  const caption = h("h3", {}, "Every value, newest first");
  const list = h(
    "table",
    { class: "table", "aria-label": "Every value" },
    heads("At", "Mission", "Trip", "Value", "Drone"),
    every,
  );
  const inside = h("div", {}, summary, caption, list);
  const element = h("div", { class: "measurements" }, empty, inside);

  const sift = () => {
    const only = lines.has(chosen.get()) ? chosen.get() : null;
    caption.textContent = only ? `Every value of ${only}` : "Every value, newest first";
    for (const row of every.rows) row.hidden = only !== null && row.dataset.mission !== only;
  };
  const update = (entries) => {
    const values = byMission(entries);
    for (const [mission, own] of values) {
      if (!lines.has(mission)) {
        const line = missionLine(mission, chosen);
        lines.set(mission, line);
        body.append(line.element);
      }
      lines.get(mission).add(own.map((entry) => entry[8]));
    }
    every.prepend(...entries.slice(-SHOWN).map(entryRow).reverse());
    while (every.rows.length > SHOWN) every.lastElementChild.remove();
    show();
  };
  const show = () => {
    empty.hidden = lines.size > 0;
    inside.hidden = lines.size === 0;
    sift();
    for (const line of lines.values()) line.highlight();
  };
  const clear = () => {
    lines.clear();
    body.replaceChildren();
    every.replaceChildren();
    show();
  };
  show();
  chosen.watch(show);
  return { element, update, clear };
}

function byMission(entries) {
  const groups = new Map();
  for (const entry of entries) groups.set(entry[2], [...(groups.get(entry[2]) ?? []), entry]);
  return groups;
}
