// Every installed block, with its documentation: dragged onto the graph, or added with Enter.

import { say } from "../announce.js";
import { edgeUnder, markDrop } from "../canvas/pointer.js";
import { camera, toWorld, viewport } from "../canvas/camera.js";
import { h, icon, fill, status } from "../dom.js";
import { EVENT, add } from "../operations.js";
import { HEIGHT, WIDTH, app, begun, snap } from "../state.js";
import { markdown } from "../text/markdown.js";

const STILL = 5;

// Not a kind of block, but drawn and dragged as one.
const AN_EVENT = {
  kind: EVENT, package: "Events", first: "What can happen: missions are made of it, or it breaks flights off.",
  accepts: [], emits: ["UNEXECUTED"],
  doc: "Declares an event. Lead it to a MissionCreator with a `creator` hook, or let an EventMonitor wait for it. Its name and its fields stand among the properties of the app.",
};

export function makePalette() {
  const search = h("input", {
    type: "search", placeholder: "Search blocks", "aria-label": "Search blocks", spellcheck: "false",
    oninput: () => draw(), onkeydown: (event) => fromSearch(event),
  });
  const list = h("ul", { class: "kinds", "aria-label": "Blocks to add" });
  const doc = h("div", { class: "doc", hidden: true, role: "region", "aria-label": "About the block", tabIndex: 0 });
  let open = null;

  function fromSearch(event) {
    const first = list.querySelector(".kind-add");
    if (event.key === "Enter" && first) add(first.dataset.kind);
    else if (event.key === "ArrowDown" && first) first.focus();
    else return;
    event.preventDefault();
  }

  function draw() {
    const words = search.value.trim().toLowerCase();
    const fits = [...app.palette, AN_EVENT].filter((one) =>
      `${one.kind} ${one.package} ${one.first} ${one.emits} ${one.accepts}`.toLowerCase().includes(words));
    const groups = [...new Set(fits.map((one) => one.package))];
    fill(list, groups.map((group) => [
      groups.length > 1 || group !== "std" ? h("li", { class: "group" }, group === "std" ? "Standard" : group) : null,
      fits.filter((one) => one.package === group).map(row),
    ]), fits.length ? null : h("li", { class: "hint nothing" }, `No block has “${search.value}” in its name or its text.`));
  }

  function row(one) {
    if (one.broken) {
      return h("li", { class: "broken" }, icon("warning", 14), h("span", {}, one.broken));
    }
    const kind = one.kind;
    return h("li", {},
      h("button", {
        type: "button", class: "kind-add", "data-kind": kind, title: `${one.first}\nClick or press Enter to add it, or drag it to its place`,
        "aria-label": `Add ${kind}: ${one.first}`,
        onpointerdown: (event) => drag(event, one), onkeydown: along,
        onclick: () => add(kind),
      }, h("span", { class: "grip" }, dots(one)), h("span", { class: "kind-name" }, one.kind)),
      h("button", {
        type: "button", class: "button quiet sign about", "aria-label": `About ${kind}`, title: `About ${kind}`,
        "aria-expanded": String(open === one), "data-about": kind, onclick: () => explain(one),
      }, icon("info", 16)));
  }

  const dots = (one) => one.emits.map((name) => h("i", { "data-status": name }));

  function along(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    const all = [...list.querySelectorAll(".kind-add")];
    (all[all.indexOf(event.target) + by] ?? (by < 0 ? search : event.target)).focus();
  }

  function explain(one) {
    open = open === one ? null : one;
    doc.hidden = !open;
    draw();
    list.querySelector(`[data-about="${one.kind}"]`)?.focus();
    if (!open) return;
    fill(doc, h("div", { class: "row" }, h("h3", {}, one.kind),
      h("button", {
        type: "button", class: "button quiet sign small spread", "aria-label": "Close", onclick: () => explain(one),
      }, icon("close", 14))), markdown(one.doc, { skipTitle: true }));
    doc.scrollTop = 0;
  }

  // The pointer carries a ghost of the block; let go upon an edge, the block goes in between.
  function drag(event, one) {
    if (event.button) return;
    const source = event.currentTarget;
    const ghost = h("div", { class: "block ghost" }, h("span", { class: "face" },
      h("span", { class: "name" }, one.kind), h("span", { class: "kind" }, one.first)));
    let far = false;
    const corner = (now) => {
      const [x, y] = toWorld(now.clientX, now.clientY);
      return [snap(x - WIDTH / 2), snap(y - HEIGHT / 2)];
    };
    const move = (now) => {
      if (!far && Math.hypot(now.clientX - event.clientX, now.clientY - event.clientY) < STILL) return;
      if (!far) document.body.append(ghost);
      far = true;
      const k = camera.k;
      ghost.style.transform = `translate(${now.clientX - WIDTH * k / 2}px, ${now.clientY - HEIGHT * k / 2}px) scale(${k})`;
      markDrop(edgeUnder(now));
    };
    const over = (now) => {
      source.removeEventListener("pointermove", move);
      source.removeEventListener("pointerup", over);
      source.removeEventListener("pointercancel", over);
      ghost.remove();
      markDrop(null);
      if (!far || now.type !== "pointerup") return;
      source.addEventListener("click", (click) => click.stopImmediatePropagation(), { once: true, capture: true });
      const under = document.elementFromPoint(now.clientX, now.clientY);
      if (!viewport.contains(under)) return say("Let go upon the graph to add the block.");
      add(one.kind, { at: corner(now), onto: edgeUnder(now) });
    };
    source.setPointerCapture(event.pointerId);
    source.addEventListener("pointermove", move);
    source.addEventListener("pointerup", over);
    source.addEventListener("pointercancel", over);
  }

  begun.heard(draw);
  return h("section", { class: "palette", "aria-labelledby": "palette-title" },
    h("div", { class: "head" }, h("h2", { id: "palette-title" }, "Blocks")),
    h("div", { class: "search" }, search), list, doc);
}
