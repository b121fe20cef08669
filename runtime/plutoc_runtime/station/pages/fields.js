// One place to fill in, whatever it holds: a field of a mission or trip, a parameter of an action.
// Quantities stay as they were written: "3 min", "40 mg"; a number alone is in SI units.

import { h, icon, plain, put, set, shown, unique } from "./dom.js";

const FACTORS = {
  ms: 0.001, s: 1, min: 60, h: 3600, mm: 0.001, cm: 0.01, m: 1, km: 1000, mg: 1e-6, g: 0.001, kg: 1,
  deg: Math.PI / 180, rad: 1, "%": 0.01, "m/s": 1, "km/h": 1 / 3.6, C: 1, K: 1,
};
const OFFSETS = { C: 273.15 };
const USUAL = ["s", "g", "m", "deg", "%", "m/s", "C"];
export const TIME = ["s", "min", "h"];

const amount = (text) => /^\s*([+-]?\d+(?:[.,]\d+)?)\s*([A-Za-z%/]*)\s*$/.exec(String(text));

// In the largest unit in which it is 1 or more, else in the smallest: 180 → "3 min".
function written(si, units) {
  const of = (unit) => (si - (OFFSETS[unit] ?? 0)) / FACTORS[unit];
  const by = units.toSorted((a, b) => FACTORS[b] - FACTORS[a]);
  const best = by.find((unit) => Math.abs(of(unit)) >= 1) ?? by.at(-1);
  return `${Number(of(best).toPrecision(6))} ${best}`;
}

// As it stands in the plan, in words.
export const inWords = (value, units = []) =>
  typeof value === "number" && units.length ? written(value, units) : String(value);

const number = (text) =>
  Number.isFinite(Number(text.replace(",", "."))) ? Number(text.replace(",", ".")) : text;

function typed(field, id, change) {
  const units = field.type === "time" ? TIME : field.units ?? [];
  const fallback = field.default ?? null;
  const usual = fallback === null ? "" : fallback === 0 && field.type === "time" ? "none"
    : inWords(fallback, units);
  // the unit of a number without one is written beside it, so that it is seen what was understood
  const unit = (units.length && usual.split(" ")[1]) || USUAL.find((one) => units.includes(one));
  const numeric = field.type === "int" || field.type === "float";
  const read = (text) => {
    const clean = text.trim();
    if (!clean) return undefined;
    if (numeric) return number(clean);
    const [, value, of] = (units.length && amount(clean)) || [];
    return value ? `${number(value)} ${of || unit}` : clean;
  };
  const dayTime = field.type === "time of day";
  const input = h("input", {
    id, type: dayTime ? "time" : "text", maxlength: 500, autocomplete: "off", spellcheck: "false",
    inputmode: numeric && "decimal",
    placeholder: usual || (unit && `such as 3 ${field.type === "time" ? "min" : unit}`),
    oninput: () => change(read(input.value), true),
    onchange() {
      const value = read(input.value);
      input.value = value ?? "";
      change(value, false);
    },
  });
  const show = (value) => {
    const text = value === undefined || value === null ? "" : inWords(value, units);
    if (document.activeElement !== input && input.value !== text) input.value = text;
  };
  return { input, show };
}

// How many rounds more, or on and on.
function rounds(id, change) {
  const count = h("input", {
    id, type: "number", min: 0, placeholder: "0",
    oninput: () => change(count.value === "" ? undefined : Number(count.value), true),
  });
  const forever = h("input", {
    type: "checkbox", onchange: () => change(forever.checked || undefined, false),
  });
  const whole = h("div", { class: "row rounds" }, count, h("span", { class: "hint" }, "more rounds"),
    h("label", { class: "check" }, forever, "until stopped"));
  return {
    input: count, whole, also: forever,
    show(value) {
      forever.checked = value === true;
      count.disabled ||= forever.checked;
      if (document.activeElement !== count) count.value = typeof value === "number" ? value : "";
    },
  };
}

function control(field, id, evaluators, change) {
  if (field.type === "rounds") return rounds(id, change);
  if (field.type === "bool") {
    const input = h("input", { id, type: "checkbox", onchange: () => change(input.checked, false) });
    return { input, show: (value) => { input.checked = value ?? field.default ?? false; } };
  }
  if (field.type !== "evaluator") return typed(field, id, change);
  const input = h("select", { id, onchange: () => change(input.value || undefined, false) },
    h("option", { value: "" }, "None"),
    evaluators.map((name) => h("option", { value: name }, plain(name))));
  return { input, show: (value) => { input.value = value ?? ""; } };
}

// field: { name, type, label?, default?, units? }; change(value, typing), undefined where it is empty.
// → { element, input, update(value, { problem, locked }) }; what somebody types in stays meanwhile.
export function fieldFor(field, { evaluators = [], change }) {
  const id = unique(field.name);
  const { input, whole = input, also, show } = control(field, id, evaluators, change);
  const words = h("span");
  const problem = h("p", { class: "problem", id: `${id}-problem` }, icon("warning"), words);
  const name = plain(field.name);
  const label = field.label ?? name[0].toUpperCase() + name.slice(1);
  set(input, "aria-describedby", problem.id);
  return {
    input,
    element: h("div", { class: "field", "data-field": field.name },
      h("label", { for: id }, label), whole, problem),
    update(value, { problem: text = "", locked = false } = {}) {
      input.disabled = locked;
      if (also) also.disabled = locked;
      show(value);
      put(words, text);
      shown(problem, text);
      set(input, "aria-invalid", text ? "true" : null);
    },
  };
}
