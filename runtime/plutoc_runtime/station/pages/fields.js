// One place to fill in, whatever it holds: fields of missions and trips, parameters of actions.
//
//   const input = fieldFor({ name, type, label, default, units }, { evaluators, change, typing });
//   host.append(input.element);
//   input.update(value, { problem: "text" | "", locked: bool });   // value undefined: not given
//
// `change(value, typing)` is called with the new value, undefined where it is empty: then the
// default counts. A field that somebody types in is not overwritten meanwhile.

import { h, put, set, shown, unique } from "./dom.js";
import { icon } from "./icons.js";
import { amount, TIME, written } from "./quantities.js";
import { plain } from "./words.js";

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function defaultWords({ type, units, default: value }) {
  if (value === null || value === undefined) return "";
  if (type === "time") return value === 0 ? "none" : written(Number(value), TIME);
  return units?.length ? written(Number(value), units) : String(value);
}

const USUAL = ["s", "g", "m", "deg", "%", "m/s", "C"];

// The unit of a number without one: that of the default, else the usual one. It is written beside
// the number at once, so that everybody sees what was understood.
function unitOf(field, units) {
  const shown = defaultWords(field).split(" ")[1];
  return shown ?? USUAL.find((unit) => units.includes(unit)) ?? units[0];
}

function quantity(text, unit) {
  const clean = text.trim();
  if (!clean) return undefined;
  const read = amount(clean);
  if (!read) return clean;
  return `${read.number} ${read.unit || unit}`;
}

function number(text) {
  const clean = text.trim().replace(",", ".");
  if (!clean) return undefined;
  return Number.isFinite(Number(clean)) ? Number(clean) : text.trim();
}

function typed(field, id, change) {
  const units = field.type === "time" ? TIME : field.units ?? [];
  const unit = unitOf(field, units);
  const read = field.type === "int" || field.type === "float" ? number
    : units.length ? (text) => quantity(text, unit) : (text) => text.trim() || undefined;
  const dayTime = field.type === "time of day";
  const fallback = defaultWords(field);
  const example = units.length ? `such as 3 ${field.type === "time" ? "min" : unit}` : null;
  const input = h("input", {
    id, type: dayTime ? "time" : "text", autocomplete: "off", spellcheck: "false",
    inputmode: field.type === "int" ? "numeric" : null,
    placeholder: fallback || example,
    maxlength: 500,
    oninput: () => change(read(input.value), true),
    onchange: () => {
      const value = read(input.value);
      if (!dayTime) input.value = value === undefined ? "" : String(value);
      change(value, false);
    },
  });
  const show = (value) => {
    if (document.activeElement === input) return;
    const text = value === undefined || value === null ? ""
      : typeof value === "number" && units.length ? written(value, units) : String(value);
    if (input.value !== text) input.value = text;
  };
  return { input, show };
}

function chosen(choices, none, id, change) {
  const input = h("select", { id, onchange: () => change(input.value || undefined, false) },
    none === null ? null : h("option", { value: "" }, none),
    choices.map((choice) => h("option", { value: choice }, plain(choice))));
  return { input, show: (value) => { input.value = value ?? ""; } };
}

function ticked(field, id, change) {
  const input = h("input", {
    id, type: "checkbox", onchange: () => change(input.checked, false),
  });
  return { input, show: (value) => { input.checked = value ?? field.default ?? false; } };
}

// How many rounds more, or on and on.
function rounds(field, id, change) {
  const count = h("input", {
    id, type: "number", min: 0, step: 1, inputmode: "numeric", placeholder: "0",
    oninput: () => change(count.value === "" ? undefined : Number(count.value), true),
  });
  const forever = h("input", {
    type: "checkbox",
    onchange: () => change(forever.checked ? true : undefined, false),
  });
  const input = h("div", { class: "rounds" }, count, h("span", { class: "hint" }, "more rounds"),
    h("label", { class: "check" }, forever, "until stopped"));
  return {
    input, invalid: count, controls: [count, forever],
    show(value) {
      forever.checked = value === true;
      count.disabled = forever.checked;
      if (document.activeElement === count) return;
      count.value = typeof value === "number" ? value : "";
    },
  };
}

function control(field, id, evaluators, change) {
  if (field.type === "rounds") return rounds(field, id, change);
  if (field.type === "evaluator") return chosen(evaluators, "None", id, change);
  if (field.type === "bool") return ticked(field, id, change);
  return typed(field, id, change);
}

export function fieldFor(field, { evaluators = [], change }) {
  const id = unique(field.name);
  const made = control(field, id, evaluators, change);
  const main = made.invalid ?? made.input;
  const words = h("span", {});
  const problem = h("p", { class: "problem", id: `${id}-problem`, hidden: true },
    icon("warning"), words);
  const label = h("label", { for: id }, field.label ?? sentence(plain(field.name)));
  set(main, "aria-describedby", `${id}-problem`);
  const element = h("div", { class: "field", "data-field": field.name },
    label, made.input, problem);
  return {
    element, input: main,
    update(value, { problem: text = "", locked = false } = {}) {
      for (const each of made.controls ?? [made.input]) each.disabled = locked;
      made.show(value);
      put(words, text);
      shown(problem, text);
      set(main, "aria-invalid", text ? "true" : null);
    },
  };
}
