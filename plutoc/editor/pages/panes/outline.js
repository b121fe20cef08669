// All blocks and edges as a tree, in the order of the text: another way through a large graph.

import { go, toEdge } from "../canvas/keys.js";
import { h, icon, keyed, put, set, shown } from "../dom.js";
import { edgeSaid } from "../operations.js";
import { START, app, begun, changed, keyOf, outOf, selected, selection, worst } from "../state.js";

export function makeOutline() {
  const list = h("ul", { class: "outline-list", role: "listbox", "aria-label": "Blocks of the app", tabIndex: 0, onkeydown: key });
  const count = h("span", { class: "count" });
  let rows = new Map();
  let at = null;

  const items = () => [START, ...[...app.view.events, ...app.view.blocks].map(({ name }) => name)].flatMap((name) => [
    { key: name, name },
    ...outOf(name).map((edge) => ({ key: keyOf(edge), edge })),
  ]);

  function draw() {
    put(count, app.view.blocks.length);
    rows = keyed(list, items(), (item) => item.key, make, update);
    mark();
  }

  const make = (item) => h("li", {
    role: "option", id: `row-${item.key.replace(/[^\w]/g, "-")}`, class: item.edge ? "out" : "",
    onclick: () => { select(item.key); },
  }, h("span", { class: "what" }), h("span", { class: "more" }), h("span", { class: "mark", hidden: true }, icon("warning", 13)));

  function update(row, { name, edge }) {
    const node = app.nodes.get(name);
    const [what, more, mark_] = row.children;
    if (edge) {
      put(what, `→ ${edge.target}`);
      put(more, edge.otherwise ? "otherwise" : edge.when.length ? edge.when.join(", ") : edge.statuses.join(", "));
      set(row, "aria-label", `Edge from ${edgeSaid(edge)}`);
    } else {
      put(what, name);
      put(more, node.terminal && !node.event ? "" : node.kind);
    }
    const level = worst((edge ?? node).problems ?? []);
    shown(mark_, level);
    set(row, "data-problem", level);
  }

  function select(key_) {
    at = key_;
    const edge = app.edges.get(key_);
    if (edge) toEdge(edge);
    else go(key_);
  }

  function mark() {
    const chosen = selection.edge ?? [...selection.blocks][0];
    if (rows.has(chosen)) at = chosen;
    for (const [key_, row] of rows) {
      set(row, "aria-selected", String(key_ === selection.edge || selection.blocks.has(key_)));
    }
    const row = rows.get(at);
    set(list, "aria-activedescendant", row?.id);
    row?.scrollIntoView({ block: "nearest" });
  }

  function key(event) {
    const keys = [...rows.keys()];
    const by = { ArrowDown: 1, ArrowUp: -1, Home: -keys.length, End: keys.length }[event.key];
    if (!by && event.key !== "Enter") return;
    event.preventDefault();
    const next = Math.min(keys.length - 1, Math.max(0, keys.indexOf(at) + (by ?? 0)));
    select(keys[next]);
    if (event.key !== "Enter") list.focus();
  }

  begun.heard(draw);
  changed.heard(draw);
  selected.heard(mark);
  return h("section", { class: "outline", "aria-labelledby": "outline-title" },
    h("div", { class: "head" }, h("h2", { id: "outline-title" }, "Outline"), count), list);
}
