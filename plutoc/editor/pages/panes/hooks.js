// Code of one's own beside its documentation: what a hook is given, and what each part means.

import { refused, say } from "../announce.js";
import { button, h } from "../dom.js";
import { ask } from "../link.js";
import { app, begun, changed } from "../state.js";
import { showPlace, typeInHooks } from "../text/pane.js";

// Goes to the function in hooks.py; where there is none yet, its stub is written first.
export async function openHook(name) {
  try {
    const found = await ask("stub", { name });
    showPlace("hooks", found.offset);
    say(`The function ${name} in hooks.py`);
  } catch (error) {
    refused(error);
  }
}

// Which names there are in a hook, each with its attributes and their meaning.
export function makeHooksAside() {
  const missing = h("div", { class: "missing" });
  const names = h("div", { class: "given" });
  const element = h("section", { class: "hooks-aside", "aria-label": "What you can use in a hook", tabIndex: 0 }, missing, names);

  function draw() {
    const open = app.view.hooks.filter((one) => !one.defined);
    missing.replaceChildren(...open.map((one) => button(`Write ${one.name}`, () => openHook(one.name), { kind: "small", sign: "code" })));
    if (!app.view.hooks.length) missing.append(h("p", { class: "hint" }, "This app declares no code of its own: add a MissionModifier or a MissionEvaluator."));
  }

  async function drawNames() {
    const { entities = [] } = await ask("entities").catch(() => ({}));
    names.replaceChildren(...entities.map(({ name, doc, attributes }) => h("details", {},
      h("summary", {}, h("code", {}, name), h("span", { class: "hint" }, ` ${doc}`)),
      h("dl", {}, attributes.map((one) => [
        h("dt", {}, h("button", { type: "button", class: "link mono", title: "Put it where the cursor is", onclick: () => typeInHooks(`${name}.${one.name}`) }, `${name}.${one.name}`),
          h("span", { class: "hint" }, ` ${one.type}`)),
        h("dd", {}, one.doc)])))));
  }

  begun.heard(() => { draw(); drawNames(); });
  changed.heard(draw);
  return element;
}

