// Elements, icons, words and fields: h("p", { class: "hint", onclick }, "Text").
// Text only ever becomes text nodes.

const PROPERTIES = new Set(["value", "checked", "disabled", "hidden", "selected", "tabIndex"]);

const kept = (children) =>
  children.flat(3).filter((one) => ![null, undefined, false].includes(one));

function build(node, props, children) {
  for (const [name, value] of Object.entries(props ?? {})) {
    if (typeof value === "function") node.addEventListener(name.slice(2), value);
    else if (PROPERTIES.has(name) && name in node) node[name] = value;
    else set(node, name, value === true ? "" : value);
  }
  node.append(...kept(children));
  return node;
}

export const h = (tag, props, ...children) => build(document.createElement(tag), props, children);

export const svg = (tag, props, ...children) =>
  build(document.createElementNS("http://www.w3.org/2000/svg", tag), props, children);

export function fill(node, ...children) {
  node.replaceChildren(...kept(children));
  return node;
}

// These three touch the page only where something has changed.
export function put(node, text) {
  if (node.textContent !== String(text)) node.textContent = text;
  return node;
}

export function set(node, name, value) {
  if (value === null || value === undefined || value === false) node.removeAttribute(name);
  else if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
  return node;
}

export function shown(node, yes) {
  if (node.hidden === Boolean(yes)) node.hidden = !yes;
  return node;
}

const made = new WeakMap(); // parent → Map of key → element

// An element for each item, the same as long as its key is there, so that focus and transitions
// survive. make(item) → element; update(element, item, i).
export function keyed(parent, items, key, make, update) {
  const before = made.get(parent) ?? new Map();
  const now = new Map();
  const focused = document.activeElement;
  items.forEach((item, i) => {
    const node = before.get(key(item)) ?? make(item);
    now.set(key(item), node);
    update?.(node, item, i);
    if (parent.children[i] !== node) parent.insertBefore(node, parent.children[i] ?? null);
  });
  while (parent.children.length > items.length) parent.lastElementChild.remove();
  made.set(parent, now);
  if (focused !== document.activeElement && parent.contains(focused)) focused.focus();
}

// Its children change their order by dragging; a finger takes them by the grip, elsewhere it scrolls.
export function reorderable(list, moved) {
  let drag = null;
  list.addEventListener("pointerdown", (event) => {
    const { target, pointerType, pointerId: id, button, clientY: y } = event;
    const from = [...list.children].findIndex((item) => item.contains(target));
    if (from < 0 || button || target.closest("button, input, select, a")) return;
    if (pointerType !== "mouse" && !target.closest(".grip")) return;
    drag = { item: list.children[from], from, to: null, y, id };
  });
  list.addEventListener("pointermove", ({ clientY: y }) => {
    if (!drag || (drag.to === null && Math.abs(y - drag.y) < 6)) return; // still a click
    const { item, id } = drag;
    list.setPointerCapture(id);
    item.classList.add("dragged");
    const others = [...list.children].filter((other) => other !== item);
    const boxes = others.map((other) => other.getBoundingClientRect());
    const at = boxes.findIndex(({ top, height }) => y < top + height / 2);
    drag.to = at < 0 ? others.length : at;
    if (list.children[drag.to] !== item) list.insertBefore(item, others[drag.to] ?? null);
  });
  const end = () => {
    if (!drag) return;
    const { item, from, to } = drag;
    drag = null;
    item.classList.remove("dragged");
    if (to !== null) moved(from, to);
  };
  list.addEventListener("pointerup", end);
  list.addEventListener("pointercancel", end);
}

let last = 0;
export const unique = (stem) => `${stem}-${(last += 1)}`;

const ICONS = {
  plus: "M12 5v14M5 12h14",
  start: "M8 5l11 7-11 7z",
  home: "M4 11l8-7 8 7M6 10v10h12V10",
  land: "M12 4v11M7 11l5 5 5-5M5 20h14",
  warning: "M12 4L2.5 20h19zM12 10v5M12 17.4v.3",
  bad: "M12 3a9 9 0 110 18 9 9 0 010-18zM9 9l6 6M15 9l-6 6",
  info: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 11v6M12 7v.3",
  lock: "M6 11h12v9H6zM8.5 11V8a3.5 3.5 0 017 0v3",
  good: "M12 3a9 9 0 110 18 9 9 0 010-18zM8 12l3 3 5-6",
  wait: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 7v5l3 2",
  pause: "M9 5v14M15 5v14",
  grip: "M9 6v.1M15 6v.1M9 12v.1M15 12v.1M9 18v.1M15 18v.1",
  close: "M6 6l12 12M18 6L6 18",
};

// A sign beside words, never instead of them.
export const icon = (name) => svg("svg", {
  viewBox: "0 0 24 24", width: 18, height: 18, fill: "none", stroke: "currentColor",
  "stroke-width": 2, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": "true",
}, svg("path", { d: ICONS[name] ?? name }));

export const button = (text, onclick, kind = "", sign = "") =>
  h("button", { class: `button ${kind}`, onclick }, sign && icon(sign), h("span", {}, text));

export const many = (n, one, more = `${one}s`) => `${n} ${n === 1 ? one : more}`;

export const plain = (name) => name.replaceAll("_", " ");

// 75 → "1:15"
export function clock(time) {
  const [all, two] = [Math.max(0, Math.floor(time)), (n) => String(n).padStart(2, "0")];
  const [hours, minutes] = [Math.floor(all / 3600), Math.floor(all / 60) % 60];
  return hours ? `${hours}:${two(minutes)}:${two(all % 60)}` : `${minutes}:${two(all % 60)}`;
}

// 75 → "1 min 15 s"
export function seconds(time) {
  const all = Math.max(0, Math.round(time));
  const [minutes, rest] = [Math.floor(all / 60), all % 60];
  return `${minutes ? `${minutes} min ` : ""}${rest || !minutes ? `${rest} s` : ""}`.trim();
}

// The same of what need not be known to the second.
export function since(time) {
  if (time < 60) return seconds(time);
  const hours = Math.floor(time / 3600);
  return hours ? `${hours} h` : `${Math.floor(time / 60)} min`;
}

export function newKey() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

// "Mission 1", "Mission 2".
export function freeName(stem, names, n = 1) {
  const name = `${stem} ${n}`;
  return names.some((other) => other.trim() === name) ? freeName(stem, names, n + 1) : name;
}

// Who wants to know of a change: b.heard(ear) → off; b.ring(what).
export function bell() {
  const ears = new Set();
  return {
    heard: (ear) => ears.add(ear) && (() => ears.delete(ear)),
    ring: (what) => [...ears].forEach((ear) => ear(what)),
  };
}

// Fields. Quantities stay as they were written, "3 min", "40 mg"; a number alone is in SI units.
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

export const inWords = (value, units = []) =>
  typeof value === "number" && units.length ? written(value, units) : String(value);

const LARGEST = 1e15; // what the station takes as a number
function number(text) {
  const value = Number(text.replace(",", "."));
  return Math.abs(value) <= LARGEST ? value : text;
}

function typed(field, id, change) {
  const units = field.type === "time" ? TIME : field.units ?? [];
  const fallback = field.default ?? null;
  const usual = fallback === null ? "" : fallback === 0 && field.type === "time" && !field.own ? "none"
    : inWords(fallback, units);
  // a number without a unit gets one, so that it is seen what was understood
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
  const heard = (typing) => () => {
    const value = read(input.value);
    const why = input.validity.badInput ? "This time is not complete." : field.wrong?.(value);
    if (!typing && !why) input.value = value ?? "";
    if (why) change(undefined, typing, { typed: input.value, why });
    else change(value, typing);
  };
  const input = h("input", {
    id, type: dayTime ? "time" : "text", maxlength: 500, autocomplete: "off", spellcheck: "false",
    inputmode: numeric && "decimal",
    placeholder: field.hint
      ?? (usual || (unit && `such as 3 ${field.type === "time" ? "min" : unit}`)
        || (field.needed && "to be filled in")),
    oninput: heard(true), onchange: heard(false),
    onblur: () => input.validity.badInput && heard(false)(),
  });
  const show = (value) => {
    const text = value === undefined || value === null ? "" : inWords(value, units);
    if (document.activeElement !== input && input.value !== text) input.value = text;
  };
  return { input, show };
}

function rounds(id, change) {
  const count = h("input", {
    id, inputmode: "numeric", placeholder: "0", maxlength: 20, autocomplete: "off",
    oninput: () => change(count.value.trim() ? number(count.value) : undefined, true),
  });
  const forever = h("input", {
    type: "checkbox", onchange: () => change(forever.checked || undefined, false),
  });
  const whole = h("div", { class: "row rounds" }, count,
    h("span", { class: "hint" }, "more rounds"),
    h("label", { class: "check" }, forever, "until stopped"));
  return {
    input: count, whole, also: forever,
    show(value) {
      forever.checked = value === true;
      count.disabled ||= forever.checked;
      if (document.activeElement !== count) count.value = value === true ? "" : value ?? "";
    },
  };
}

function control(field, id, evaluators, change) {
  if (field.type === "rounds") return rounds(id, change);
  if (field.type === "bool" && field.needed) {
    const onchange = () => change({ yes: true, no: false }[input.value], false);
    const input = h("select", { id, onchange },
      ["", "yes", "no"].map((value) => h("option", { value }, value || "Choose")));
    return { input, show: (value) => { input.value = value === undefined ? "" : value ? "yes" : "no"; } };
  }
  if (field.type === "bool") {
    const onchange = () => change(input.checked, false);
    const input = h("input", { id, type: "checkbox", onchange });
    return { input, show: (value) => { input.checked = value ?? field.default ?? false; } };
  }
  if (field.type !== "evaluator") return typed(field, id, change);
  const input = h("select", { id, onchange: () => change(input.value || undefined, false) },
    h("option", { value: "" }, "The app’s own"),
    evaluators.map((name) => h("option", { value: name }, plain(name))));
  return { input, show: (value) => { input.value = value ?? ""; } };
}

// field: { name, type, label?, default?, units?, own?, needed?, wrong?: value → why it cannot be in the plan }
// change(value, typing, draft): undefined is empty; draft: { typed, why }, for what is not in the plan
// → { element, input, update(value, { problem, locked }) }; what is typed in stays meanwhile.
export function fieldFor(field, { evaluators = [], change }) {
  const id = unique(field.name);
  let known; // the value that was typed or shown here
  let latest = [];
  const foreign = () => known !== String(latest[0] ?? "");
  const { input, whole = input, also, show } = control(field, id, evaluators,
    (value, typing, draft) => {
      const text = String(draft?.typed ?? value ?? "");
      if (!typing && text === known && foreign()) return; // it is left: theirs stays
      known = text;
      latest[0] = draft?.typed ?? value;
      change(value, typing, draft);
    });
  const words = h("span");
  const problem = h("p", { class: "problem", id: `${id}-problem`, "aria-live": "polite" }, icon("warning"), words);
  const name = plain(field.name);
  const label = field.label ?? name[0].toUpperCase() + name.slice(1);
  set(input, "aria-describedby", problem.id);
  set(input, "aria-required", field.needed && "true");
  input.addEventListener("blur", () => one.update(...latest));
  const one = {
    input,
    element: h("div", { class: "field", "data-field": field.name },
      h("label", { for: id }, label), whole, problem),
    update(value, { problem: own = "", locked = false } = {}) {
      latest = [value, { problem: own, locked }];
      input.disabled = locked;
      if (also) also.disabled = locked;
      show(value);
      const now = String(value ?? "");
      if (document.activeElement !== input) known = now;
      const text = !foreign() ? own
        : `Another page has changed this to “${now}”: type on to replace that, or leave this field `
          + `to take it. ${own}`;
      put(words, text);
      shown(problem, text);
      set(input, "aria-invalid", text ? "true" : null);
    },
  };
  return one;
}
