// What is selected: a block, an edge, several, or nothing, which means the app.

import { run } from "../commands.js";
import { button, h } from "../dom.js";
import { app, begun, changed, chosenBlocks, isEnd, only, selected, selection } from "../state.js";
import { appPanel } from "./app.js";
import { blockPanel } from "./block.js";
import { edgePanel } from "./edge.js";

let current = null;

export function makeProperties() {
  const body = h("div", { class: "properties-body", tabIndex: -1 });
  let kind = "";

  function draw() {
    const one = only();
    const now = selection.edge ? "edge" : one && !isEnd(one) ? "block" : chosenBlocks().length > 1 ? `many ${chosenBlocks().length}`
      : one ? `end ${one}` : "app";
    if (now !== kind) {
      kind = now;
      current = make(now);
      body.replaceChildren(current.element);
    } else {
      current.update();
    }
  }

  begun.heard(draw);
  changed.heard(draw);
  selected.heard(draw);
  return h("section", { class: "properties", "aria-label": "Properties" }, body);
}

function make(now) {
  if (now === "edge") return edgePanel();
  if (now === "block") return blockPanel(only());
  if (now === "app") return appPanel();
  const several = now.startsWith("many");
  const name = only();
  const element = h("div", { class: "panel" },
    h("div", { class: "panel-top" }, h("h3", {}, several ? `${chosenBlocks().length} blocks` : name),
      several && button("Duplicate", () => run("duplicate"), { kind: "small", sign: "copy" }),
      several && button("Remove", () => run("remove"), { kind: "small danger", sign: "trash" })),
    h("p", { class: "hint" }, several ? "Ctrl+C copies them as Pluto text; Alt and an arrow key moves them." : app.nodes.get(name).doc));
  return { element, update() {}, focus: () => element.querySelector("button")?.focus() };
}

export const focusProperties = () => current?.focus();
