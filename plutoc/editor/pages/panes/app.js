// The properties of the app itself, where nothing is selected: title, drones, code of one's own.

import { choose } from "../dialogs/chooser.js";
import { button, h, icon, keyed } from "../dom.js";
import { declare, removeDeclaration, rewrite, rewriteField, setArgument, setTitle } from "../operations.js";
import { app } from "../state.js";
import { fieldOf } from "./fields.js";
import { openHook } from "./hooks.js";

const NEW = [
  { id: "category", label: "A category of drones", detail: "what they can do and carry", text: (name) => `category ${name} can take_photo, measure` },
  { id: "evaluator", label: "An evaluator", detail: "judges finished missions; it may take values: (least: int = 2)", text: (name) => `evaluator ${name}` },
  { id: "modifier", label: "A modifier", detail: "called for every mission that passes", text: (name) => `modifier ${name}` },
  { id: "action", label: "An action", detail: "what a drone does at its target; -> float says what it gives", text: (name) => `action ${name}` },
  { id: "policy", label: "A policy", detail: "chooses the drone", text: (name) => `policy ${name}` },
  { id: "event", label: "An event", detail: "what can happen; it may have fields: (kind: text)", text: (name) => `event ${name}` },
  { id: "creator", label: "A creator", detail: "makes a mission of an event", text: (name) => `creator ${name}` },
  { id: "mission", label: "A field of missions", detail: "filled in by users, read by hooks", text: (name) => `mission has ${name}: text = ""` },
  { id: "trip", label: "A field of trips", detail: "filled in by users, read by hooks", text: (name) => `trip has ${name}: text = ""` },
];

let fresh = ""; // what was declared just now: its name is typed over next
const unnamed = new Set(); // fields that still have the name that they came with: no plan knows it

export function appPanel() {
  const title = h("input", {
    type: "text", "aria-label": "Title", class: "title-input", autocomplete: "off", placeholder: "Title of the app",
    onchange: () => setTitle(title.value.trim()),
    onkeydown: (event) => { if (event.key === "Escape") title.value = app.view.title; },
  });
  const categories = h("div", { class: "declarations" });
  const fields = h("div", { class: "declarations" });
  const hooks = h("div", { class: "declarations" });
  const events = h("div", { class: "declarations" });
  const element = h("div", { class: "panel" },
    h("div", { class: "panel-top" }, title,
      button("Declare", () => declareNew(), { kind: "small", sign: "plus", title: "A category of drones, or code of your own" })),
    h("h3", {}, "Drones"), categories, h("h3", {}, "Fields of missions and trips"), fields,
    h("h3", {}, "Events"), events, h("h3", {}, "Code of your own"), hooks);

  function update() {
    const held = document.activeElement;
    const row = element.contains(held) && held.closest(".declaration");
    const [list, at] = [row?.parentElement, [...row?.parentElement?.children ?? []].indexOf(row)];
    if (document.activeElement !== title) title.value = app.view.title;
    keyed(categories, app.view.categories, (one) => one.name, categoryOf, (item, one) => item.update(one));
    if (!app.view.categories.length) categories.replaceChildren(h("p", { class: "hint" }, "Any drone does everything. Declare a category to say what drones can do and carry."));
    keyed(fields, app.view.fields, (one) => one.name, fieldRow, (item, one) => item.update(one));
    if (!app.view.fields.length) fields.replaceChildren(h("p", { class: "hint" }, "None but those that blocks bring. Declare one to have users fill in what your code reads."));
    const own = app.view.events.filter(({ text }) => text);
    keyed(events, own, (one) => one.name, eventRow, (item, one) => item.update(one));
    if (!own.length) events.replaceChildren(h("p", { class: "hint" }, "None but late and lost. Declare one to have a mission made, or a flight broken off, when something happens."));
    keyed(hooks, app.view.hooks, (one) => one.name, hookOf, (item, one) => item.update(one));
    if (!app.view.hooks.length) hooks.replaceChildren(h("p", { class: "hint" }, "None. A MissionModifier or a MissionEvaluator calls a function of yours; adding one declares it."));
    if (row && !held.isConnected) list.children[at]?.querySelector("input")?.focus(); // it has another name now
    nameFresh();
  }

  function nameFresh() {
    const input = fresh && element.querySelector(`[data-declares="${fresh}"]`);
    if (!input) return;
    const name = fresh.split(".").at(-1);
    const at = new RegExp(`\\b${name}\\b`).exec(input.value).index;
    fresh = "";
    input.focus();
    input.setSelectionRange(at, at + name.length);
  }

  update();
  return { element, update, focus: () => title.focus() };
}

// A declaration as one line of Pluto text, which can be changed.
function line(one, change = rewrite) {
  const input = h("input", {
    type: "text", class: "mono", spellcheck: "false", autocomplete: "off", "aria-label": `The declaration of ${one.name}`, "data-declares": one.name,
    onchange: () => { if (input.value.trim() !== input.dataset.text) change(one.name, input.value.trim()); },
    onkeydown: (event) => { if (event.key === "Escape") input.value = input.dataset.text; },
  });
  const update = ({ text }) => {
    if (document.activeElement !== input) input.value = text;
    input.dataset.text = input.title = text;
  };
  update(one);
  return { input, update };
}

const remove = (one) => h("button", {
  type: "button", class: "button quiet sign small danger", "aria-label": `Remove ${one.name}`, title: "Remove", onclick: () => removeDeclaration(one.name),
}, icon("trash", 16));

function categoryOf(one) {
  const text = line(one);
  const fields = one.arguments.map((argument) => fieldOf(argument, (value) => setArgument(one.name, argument.name, value)));
  const item = h("div", { class: "declaration" }, h("div", { class: "row" }, text.input, remove(one)),
    h("details", {}, h("summary", {}, "payload, speed, battery"), h("div", { class: "fields narrow" }, fields.map(({ element }) => element))));
  item.update = (next) => {
    text.update(next);
    next.arguments.forEach((argument, i) => fields[i].update(argument));
  };
  return item;
}

function fieldRow(one) {
  const text = line(one, (name, written) => rewriteField(name, written, { planned: !unnamed.delete(name) }));
  const item = h("div", { class: "declaration" }, h("div", { class: "row" }, h("code", { class: "hint" }, `${one.on} has`), text.input, remove(one)));
  item.update = (next) => text.update(next);
  return item;
}

function eventRow(one) {
  const text = line(one);
  const item = h("div", { class: "declaration" }, h("div", { class: "row" }, text.input, remove(one)));
  item.update = (next) => text.update(next);
  return item;
}

function hookOf(one) {
  const text = line(one);
  const code = button("", () => openHook(one.name), { kind: "small", sign: "code" });
  const item = h("div", { class: "declaration" }, h("div", { class: "row" }, text.input, code, remove(one)));
  item.update = (next) => {
    text.update(next);
    code.lastChild.textContent = next.defined ? "Code" : "Write";
    code.setAttribute("aria-label", next.defined ? `Open the code of ${one.name}` : `Write the code of ${one.name}`);
  };
  return item;
}

async function declareNew() {
  const id = await choose({ title: "Declare", options: NEW });
  const one = NEW.find((other) => other.id === id);
  if (!one) return;
  const taken = new Set([...app.nodes.keys(), ...app.view.hooks.map(({ name }) => name), ...app.view.categories.map(({ name }) => name)]);
  const isField = id === "mission" || id === "trip";
  for (const field of app.view.fields) if (field.on === id) taken.add(field.name.split(".")[1]);
  const first = isField ? "note" : `my_${id}`;
  let name = first;
  for (let n = 2; taken.has(name); n += 1) name = `${first}_${n}`;
  fresh = isField ? `${id}.${name}` : name;
  if (isField) unnamed.add(fresh);
  if (!await declare(one.text(name))) fresh = "";
}
