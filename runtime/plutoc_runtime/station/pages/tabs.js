// The pages of the station, one at a time: a tab each, in the address after #.
//
//   const pages = tabs([{ id: "missions", title: "Missions" }, …], (id) => …);
//   pages.bar  pages.element   pages.go("trips")   pages.now()   pages.panel("trips")

import { h, set, shown } from "./dom.js";

const STEPS = { ArrowRight: 1, ArrowLeft: -1 };

export function tabs(list, opened) {
  const ids = list.map((page) => page.id);
  const buttons = new Map();
  const panels = new Map();
  let now = "";

  function go(id, quiet = false) {
    if (!ids.includes(id)) return;
    now = id;
    for (const other of ids) {
      set(buttons.get(other), "aria-selected", String(other === id));
      buttons.get(other).tabIndex = other === id ? 0 : -1;
      shown(panels.get(other), other === id);
    }
    if (!quiet && location.hash !== `#${id}`) history.pushState(null, "", `#${id}`);
    opened(id);
  }

  function keys(event) {
    const at = ids.indexOf(now);
    const to = { Home: 0, End: ids.length - 1 }[event.key]
      ?? (event.key in STEPS ? (at + STEPS[event.key] + ids.length) % ids.length : null);
    if (to === null) return;
    event.preventDefault();
    go(ids[to]);
    buttons.get(ids[to]).focus();
  }

  for (const { id, title } of list) {
    buttons.set(id, h("button", {
      class: "tab", role: "tab", id: `tab-${id}`, "aria-controls": `page-${id}`,
      onclick: () => go(id),
    }, title));
    panels.set(id, h("section", {
      class: "page", role: "tabpanel", id: `page-${id}`, "aria-labelledby": `tab-${id}`,
      hidden: true,
    }));
  }
  const bar = h("div", { class: "tabs", role: "tablist", "aria-label": "Pages", onkeydown: keys },
    ...buttons.values());
  window.addEventListener("popstate", () => go(location.hash.slice(1) || ids[0], true));
  const element = h("main", {}, ...panels.values());
  return { bar, element, go, now: () => now, panel: (id) => panels.get(id) };
}
