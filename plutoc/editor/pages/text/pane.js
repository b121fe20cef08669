// The text beside the picture, and hooks.py behind it: the same app, both ways at once.

import { say, tell } from "../announce.js";
import { reveal } from "../canvas/camera.js";
import { h, many, put, shown } from "../dom.js";
import { ask } from "../link.js";
import { app, begun, changed, choose, isEnd, keyOf, selected, selection } from "../state.js";

let editors = null; // their code is large: the graph is drawn before it is there
let waiting = []; // what is to be done with them then
export const hasText = () => editors !== null;
const withEditors = (use) => (editors ? use(editors) : waiting.push(use));
let turn = () => {};

export function makeText(hooksAside) {
  const hosts = { app: h("div", { class: "code" }), hooks: h("div", { class: "code" }) };
  const panels = {
    app: h("div", { class: "text-panel", role: "tabpanel", id: "panel-app", "aria-labelledby": "tab-app" }, hosts.app),
    hooks: h("div", { class: "text-panel", role: "tabpanel", id: "panel-hooks", "aria-labelledby": "tab-hooks", hidden: true }, hosts.hooks, hooksAside),
  };
  const tab = (file, words) => h("button", {
    type: "button", role: "tab", class: "tab", id: `tab-${file}`, "aria-controls": `panel-${file}`,
    onclick: () => turn(file), onkeydown: (event) => {
      if (!["ArrowLeft", "ArrowRight"].includes(event.key)) return;
      event.preventDefault();
      turn(file === "app" ? "hooks" : "app").focus();
    },
  }, h("span", {}, words), h("span", { class: "count", hidden: true }));
  const tabs = { app: tab("app", "Text"), hooks: tab("hooks", "hooks.py") };
  turn = (file) => {
    for (const one of ["app", "hooks"]) {
      shown(panels[one], one === file);
      tabs[one].setAttribute("aria-selected", String(one === file));
      tabs[one].tabIndex = one === file ? 0 : -1;
    }
    return tabs[file];
  };
  turn("app");
  begun.heard(({ text, hooks }) => {
    put(tabs.app.firstChild, app.file);
    if (!editors && !waiting.length) load(hosts);
    withEditors(() => {
      editors.app.sync.begin(text);
      editors.hooks.sync.begin(hooks?.text ?? "");
    });
    after(tabs);
  });
  changed.heard((push) => {
    if (push.changes?.length) withEditors(() => editors[push.file]?.sync.heard(push));
    after(tabs);
    const view = editors?.app.view;
    if (push.by === app.client && push.file === "app" && view?.hasFocus) cursor(view.state.selection.main.head);
  });
  selected.heard(markChosen);
  return h("section", { class: "text", "aria-label": "Text" },
    h("div", { class: "head tabbed" }, h("div", { class: "tabs", role: "tablist", "aria-label": "Files" }, tabs.app, tabs.hooks)),
    panels.app, panels.hooks);
}

async function load(hosts) {
  const { makeEditors } = await import("./editor.js");
  editors = makeEditors(hosts, cursor);
  for (const use of waiting.splice(0)) use();
}

function after(tabs) {
  for (const file of ["app", "hooks"]) {
    const found = app.view.problems.filter((one) => one.file === file);
    withEditors(() => editors[file].problems(found));
    const count = tabs[file].lastChild;
    shown(count, found.length);
    put(count, found.length);
    const errors = found.some((one) => one.severity === "error");
    count.className = `count ${errors ? "bad" : "warn"}`;
    count.setAttribute("aria-label", many(found.length, "problem"));
  }
  markChosen();
}

function markChosen() {
  const edge = app.edges.get(selection.edge);
  const nodes = [...selection.blocks].filter((name) => !isEnd(name)).map((name) => app.nodes.get(name));
  const ranges = [...nodes, ...(edge ? [edge] : [])].filter((one) => one?.to).map((one) => [one.from, one.to]);
  withEditors(() => editors.app.mark(ranges));
}

// The cursor in the text selects what it stands in.
function cursor(offset) {
  const inside = ({ from, to }) => from !== null && from <= offset && offset <= to;
  const block = app.view.blocks.find(inside);
  const edge = app.view.edges.find(inside);
  if (block) {
    choose([block.name]);
    reveal(app.nodes.get(block.name));
  } else if (edge) {
    choose([], keyOf(edge));
  } else if (selection.blocks.size || selection.edge) {
    choose([]);
  }
}

export function showPlace(file, from, to = from, focus = true) {
  turn(file);
  withEditors(() => editors[file].show(from, to, focus));
}

// Puts text where the cursor is, as if it were typed.
export function typeInHooks(text) {
  withEditors(() => editors.hooks.type(text));
}

const fileShown = () => (document.getElementById("tab-app").getAttribute("aria-selected") === "true" ? "app" : "hooks");

// From a name to where it is declared; from there to its function in hooks.py.
export async function toDefinition() {
  await typedAll();
  const file = fileShown();
  const offset = editors[file].view.state.selection.main.head;
  const { places } = await ask("definition", { file, offset });
  const isHere = (one) => one.file === file && one.from <= offset && offset <= one.to;
  const place = places.find((one) => !isHere(one));
  if (place) showPlace(place.file, place.from, place.to);
  else tell(places.length ? "This is its definition." : "No name that is declared stands at the cursor.");
}

export function focusText() {
  const file = fileShown();
  withEditors(() => editors[file].view.focus());
  say(`${file === "app" ? app.file : "hooks.py"}: press Escape and then Tab to leave`);
}

// Answers that come of the server's text wait until it has all that was typed.
export async function typedAll() {
  if (editors) await Promise.all([editors.app.sync.atRest(), editors.hooks.sync.atRest()]);
}

