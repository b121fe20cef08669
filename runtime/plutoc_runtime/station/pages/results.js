// What happens, line by line, and what the missions brought: measurements, photos, verdicts.

import { clock, h, many, plain, put, set, shown, svg } from "./dom.js";
import { mapPicture } from "./floor.js";
import { mark, round, sieve } from "./table.js";

const SHOWN = 1000; // lines on the page
const TOGETHER = 50; // lines in a block of the page: those out of sight cost nothing
const KINDS = {
  "": "All lines", info: "News", good: "Good news", bad: "Trouble", hook: "The app's own lines",
};
const SIGNS = { good: "✓", bad: "!", hook: "›" };

const line = ([, time, mission, text, kind]) => h("div", { class: `log-line ${kind}` },
  h("span", { class: "when" }, clock(time)),
  h("span", { class: "what", "aria-hidden": "true" }, SIGNS[kind]),
  mission !== null && h("b", null, mission), h("span", null, text));

export function consoleView(context, save) {
  const { live } = context;
  const option = ([value, label]) => h("option", { value }, label);
  const text = h("input", {
    type: "search", class: "input", placeholder: "Find text", "aria-label": "Find text",
    oninput: rewrite,
  });
  const of = h("select", { class: "input", "aria-label": "Of which mission", onchange: rewrite },
    option(["", "All missions"]));
  const kind = h("select", { class: "input", "aria-label": "Which lines", onchange: rewrite },
    Object.entries(KINDS).map(option));
  const lines = h("div", {
    class: "log", role: "log", "aria-live": "off", "aria-label": "Console", tabIndex: 0,
    onscroll: () => {
      following = lines.scrollTop + lines.clientHeight >= lines.scrollHeight - 8;
      if (following) unread = 0;
      shown(newest, unread);
    },
  });
  const newest = h("button", {
    class: "button small newest", hidden: true, onclick: () => {
      following = true;
      follow();
      lines.focus();
    },
  });
  const missions = new Set();
  let following = true;
  let unread = 0;
  let block = null;

  const fits = ([, , mission, said, sort]) => (!of.value || mission === of.value)
    && (!kind.value || sort === kind.value)
    && `${mission ?? ""} ${said}`.toLowerCase().includes(text.value.toLowerCase());
  function follow() {
    if (following) {
      lines.scrollTop = lines.scrollHeight;
      unread = 0;
    }
    put(newest, `${many(unread, "new line")} below`);
    shown(newest, unread);
  }
  function add(entries) {
    for (const entry of entries) {
      if (!block || block.childElementCount >= TOGETHER) {
        block = h("div", { class: "log-block" });
        lines.append(block);
      }
      block.append(line(entry));
    }
    while (lines.childElementCount > SHOWN / TOGETHER) lines.firstElementChild.remove();
    follow();
  }
  function rewrite() {
    block = null;
    following = true;
    lines.replaceChildren();
    add(live.log.filter(fits).slice(-SHOWN));
  }
  function update(entries) {
    for (const [, , mission] of entries) {
      if (mission === null || missions.has(mission)) continue;
      missions.add(mission);
      of.append(option([mission, mission]));
    }
    const fitting = entries.filter(fits).slice(-SHOWN);
    if (!following) unread += fitting.length;
    add(fitting);
  }
  function clear() {
    missions.clear();
    of.replaceChildren(of.firstElementChild);
    block = null;
    lines.replaceChildren();
  }
  new ResizeObserver(follow).observe(lines);
  return {
    tools: [text, of, kind, save("/api/console.txt")], body: [lines, newest], update, clear,
  };
}

const LINES = 300;
const PHOTOS = 60;
const VALUES = 60; // in a sparkline
const written = (value) => (typeof value === "number" ? Number(value.toPrecision(4)) : value);

// The name of a mission, which one presses to see it everywhere.
const link = (chosen, mission) =>
  h("button", { class: "link", onclick: () => chosen.set(mission) }, mission);

// How a value went, in a few pixels; a ring marks the newest.
function sparkline(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const points = values.map((value, i) => [4 + (i * 80) / (values.length - 1),
    22 - (high > low ? (18 * (value - low)) / (high - low) : 9)]);
  const [cx, cy] = points.at(-1);
  return svg("svg", { class: "spark", width: 88, height: 26, "aria-hidden": "true" },
    svg("polyline", { points: points.join(" ") }), svg("circle", { cx, cy, r: 2.6 }));
}

// A line for each place of each mission where something was measured, the newest first.
function measurements(chosen) {
  const body = h("tbody");
  const lines = new Map();
  const make = (mission, trip) => {
    const cells = Array.from({ length: 3 }, () => h("td", { class: "num" }));
    const element = h("tr", null,
      h("th", { scope: "row" }, link(chosen, mission)),
      h("td", null, trip), ...cells);
    return { element, cells, mission, values: [] };
  };
  const heads = ["Mission", "Trip", "Newest", "How it went", "At"].map((name) =>
    h("th", { scope: "col" }, name));
  const highlight = () => {
    for (const { element, mission } of lines.values()) mark(element, mission === chosen.name);
  };
  chosen.changed.heard(highlight);
  return {
    element: h("table", { class: "table" }, h("thead", null, h("tr", null, heads)), body),
    add(entries) {
      for (const [, time, mission, trip, , , , , value] of entries.slice(-LINES)) {
        const key = JSON.stringify([mission, trip]);
        if (!lines.has(key)) lines.set(key, make(mission, trip));
        const { element, cells, values } = lines.get(key);
        if (typeof value === "number") values.push(value);
        values.splice(0, values.length - VALUES);
        put(cells[0], written(value));
        if (values.length > 1) cells[1].replaceChildren(sparkline(values));
        put(cells[2], clock(time));
        body.prepend(element);
      }
      while (body.rows.length > LINES) body.lastElementChild.remove();
      highlight();
    },
    clear() {
      lines.clear();
      body.replaceChildren();
    },
  };
}

// The piece of the floor plan that the camera saw.
function ground(map, { position: [x, y], width, height }) {
  const [across, up] = map.size;
  const picture = svg("image", { width: across, height: up, preserveAspectRatio: "none" });
  const lines = Array.from({ length: Math.ceil(Math.max(across, up)) }, (_, i) =>
    `M${i} 0V${up}M0 ${up - i}H${across}`);
  mapPicture(map).then((address) => address && set(picture, "href", address));
  return svg("svg", {
    class: "ground", "aria-hidden": "true",
    viewBox: `${x - width / 2} ${up - y - height / 2} ${width} ${height}`,
  }, svg("rect", { width: across, height: up }), picture, svg("path", { d: lines.join("") }));
}

function photos({ app }, chosen, floor) {
  const list = h("ul", { class: "photos" });
  const layer = floor.layer("photo-frame");
  const frame = ({ position: [x, y], width, height }) => layer.replaceChildren(
    svg("rect", { x: x - width / 2, y: y - height / 2, width, height }));
  const card = ([, time, mission, trip, , , , , photo]) => {
    const [x, y] = photo.position;
    const sees = photo.sees.map(plain).join(", ");
    const sharp = photo.sharpness < 0.4 ? "blurred" : photo.sharpness < 0.7 ? "soft" : "sharp";
    const act = () => frame(photo);
    const away = () => layer.replaceChildren();
    return h("li", null, h("button", {
      class: "photo", "data-sees": Boolean(sees), "data-sharp": sharp,
      onpointerenter: act, onfocus: act, onpointerleave: away, onblur: away,
      onclick: () => {
        chosen.set(mission);
        floor.reveal(x, y);
      },
    }, ground(app.map, photo), h("b", null, sees || "nothing special"),
    h("span", null, `${mission}, ${trip}`),
    h("small", null, `${clock(time)} at ${round(x)}, ${round(y)}, ${sharp}`)));
  };
  return {
    element: list,
    add(entries) {
      list.prepend(...entries.slice(-PHOTOS).map(card).reverse());
      while (list.childElementCount > PHOTOS) list.lastElementChild.remove();
    },
    clear: () => list.replaceChildren(),
  };
}

function verdicts(chosen) {
  const list = h("ul", { class: "verdicts" });
  return {
    element: list,
    add(entries) {
      list.prepend(...entries.slice(-LINES).map(([, time, mission, , , , , , text]) => h("li", null,
        h("span", { class: "when" }, clock(time)),
        link(chosen, mission), h("span", null, text))).reverse());
      while (list.childElementCount > LINES) list.lastElementChild.remove();
    },
    clear: () => list.replaceChildren(),
  };
}

export function resultsView(context, chosen, floor, save) {
  const part = (kind, none, view) => ({ kind, none, ...view });
  const parts = {
    Measurements: part("value", "Nothing has been measured yet.", measurements(chosen)),
    Photos: part("photo", "No photo has been taken yet.", photos(context, chosen, floor)),
  };
  if (context.app.evaluators.length) {
    parts.Verdicts = part("verdict", "No mission has been judged yet.", verdicts(chosen));
  }
  const all = Object.entries(parts);
  const empty = h("p", { class: "empty" });
  let now = "";
  const show = () => {
    for (const [name, { element, none, number }] of all) {
      shown(element, name === now && number);
      if (name !== now) continue;
      shown(empty, !number);
      put(empty, none);
    }
  };
  let picked = false;
  const tabs = sieve(Object.keys(parts), "Which results", (name) => {
    now = name;
    picked = true;
    show();
  });
  function update(entries) {
    for (const [name, part] of all) {
      const own = entries.filter((entry) => entry[7] === part.kind && entry[8] !== null);
      if (!own.length) continue;
      part.number += own.length;
      tabs.count(name, part.number);
      part.add(own);
      if (!picked && !parts[now].number) tabs.pick(name);
    }
    show();
  }
  function clear() {
    for (const [name, part] of all) {
      part.number = 0;
      tabs.count(name, 0);
      part.clear();
    }
    show();
  }
  clear();
  tabs.pick("Measurements");
  picked = false;
  return {
    tools: [tabs, save("/api/results.json")], body: [empty, all.map(([, part]) => part.element)],
    update, clear,
  };
}
