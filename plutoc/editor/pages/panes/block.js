// The properties of one block: its name, what its kind declares, where its missions go.

import { toEdge } from "../canvas/keys.js";
import { run } from "../commands.js";
import { button, h, icon, keyed, put, status } from "../dom.js";
import { edgeSaid, guardSaid, rename, setArgument } from "../operations.js";
import { app, keyOf, only, outOf } from "../state.js";
import { fieldOf } from "./fields.js";
import { openHook } from "./hooks.js";
import { problemRow } from "./problems.js";

const sets = (label, statuses) => h("div", { class: "passes" }, h("span", { class: "hint" }, label),
  statuses?.length ? statuses.map((one) => [status(one), " "]) : h("span", { class: "hint" }, statuses ? "nothing" : "not known"));

export function blockPanel(name) {
  const input = h("input", {
    type: "text", "aria-label": "Name", spellcheck: "false", autocomplete: "off", class: "title-input",
    onchange: () => { const to = input.value.trim(); if (to && to !== input.dataset.name) rename(input.dataset.name, to); },
    onkeydown: (event) => { if (event.key === "Escape") input.value = input.dataset.name; },
  });
  const kind = h("p", { class: "kind-line" });
  const fields = h("div", { class: "fields" });
  const made = new Map(); // name of a parameter → its field
  const hook = h("div", { class: "hook-line" });
  const out = h("ul", { class: "ways" });
  const problems = h("ul", { class: "problem-list" });
  const statuses = h("div", { class: "two" });
  const element = h("div", { class: "panel" },
    h("div", { class: "panel-top" }, input,
      button("Connect", (event) => run("connect", event), { kind: "small", sign: "wire", title: "Choose a block to connect to (C)" }),
      h("button", { type: "button", class: "button quiet sign small", title: "Duplicate (Ctrl+D)", "aria-label": "Duplicate", onclick: () => run("duplicate") }, icon("copy", 16)),
      h("button", { type: "button", class: "button quiet sign small danger", title: "Remove (Delete)", "aria-label": "Remove", onclick: () => run("remove") }, icon("trash", 16))),
    kind, fields, hook, statuses, out, problems);

  function update() {
    const block = app.nodes.get(only() ?? name);
    if (!block || block.terminal) return;
    if (document.activeElement !== input || input.dataset.name !== block.name) input.value = block.name;
    input.dataset.name = block.name;
    put(kind, `${block.kind}${block.package && block.package !== "std" ? ` of ${block.package}` : ""}. ${block.doc}`);
    keyed(fields, block.arguments, (one) => `${one.name} ${Boolean(one.choices)}`, (one) => {
      const field = fieldOf(one, (value) => setArgument(input.dataset.name, one.name, value));
      made.set(one.name, field);
      return field.element;
    }, (_element, one) => made.get(one.name).update(one));
    hook.replaceChildren(...hookLine(block));
    statuses.replaceChildren(sets("takes", block.known ? block.accepts : null), sets("gives", block.known ? block.emits : null));
    keyed(out, outOf(block.name), keyOf, () => h("li", {}), (item, edge) => {
      item.replaceChildren(h("button", { type: "button", class: "way", title: edgeSaid(edge), onclick: () => toEdge(edge) },
        h("span", {}, `→ ${edge.target} `, h("span", { class: "hint" }, guardSaid(edge))),
        h("span", { class: "chips-inline" }, edge.statuses.map((one) => status(one)))));
    });
    problems.replaceChildren(...block.problems.map((i) => problemRow(app.view.problems[i], i)));
  }

  update();
  return { element, update, focus: () => { input.focus(); input.select(); } };
}

function hookLine(block) {
  if (!block.hook) return [];
  const own = app.view.hooks.find((one) => one.name === block.hook);
  const words = own?.defined ? "Open its code" : "Write its code";
  return [button(`${words}: ${block.hook}`, () => openHook(block.hook), { kind: "small", sign: "code" })];
}
