// Elements, icons and small helpers: h("p", { class: "hint", onclick }, "Text").
// Text only ever becomes text nodes; styles are set as properties, which the page's policy allows.

const PROPERTIES = new Set(["value", "checked", "disabled", "hidden", "selected", "tabIndex", "open"]);

const kept = (children) =>
  children.flat(4).filter((one) => ![null, undefined, false, ""].includes(one));

function build(node, props, children) {
  for (const [name, value] of Object.entries(props ?? {})) {
    if (typeof value === "function") node.addEventListener(name.slice(2), value);
    else if (name === "style") Object.assign(node.style, value);
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

// These touch the page only where something has changed.
export function set(node, name, value) {
  if (value === null || value === undefined || value === false) node.removeAttribute(name);
  else if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
  return node;
}

export function put(node, text) {
  if (node.textContent !== String(text)) node.textContent = text;
  return node;
}

export function shown(node, yes) {
  if (node.hidden === Boolean(yes)) node.hidden = !yes;
  return node;
}

const made = new WeakMap(); // parent → Map of key → element

// An element for each item, the same as long as its key is there, so that focus survives.
export function keyed(parent, items, key, make, update) {
  const before = made.get(parent) ?? new Map();
  const now = new Map();
  for (const item of items) {
    const node = before.get(key(item)) ?? make(item);
    now.set(key(item), node);
    update?.(node, item);
  }
  for (const [id, node] of before) if (!now.has(id)) node.remove();
  let place = parent.firstChild;
  for (const node of now.values()) {
    if (node === place) place = place.nextSibling;
    else parent.insertBefore(node, place);
  }
  made.set(parent, now);
  return now;
}

let last = 0;
export const unique = (stem) => `${stem}-${(last += 1)}`;

export const many = (n, one, more = `${one}s`) => `${n} ${n === 1 ? one : more}`;

const MAC = /Mac|iPhone|iPad/.test(navigator.platform);

// "Ctrl+Z" → "⌘Z" where keyboards are so.
export const keysShown = (keys) =>
  MAC ? keys.replace("Ctrl+", "⌘").replace("Shift+", "⇧").replace("Alt+", "⌥") : keys;

// The name of what was pressed: "Ctrl+Shift+Z", "Delete", "?".
export function pressed({ key, ctrlKey, metaKey, shiftKey, altKey }) {
  const letter = /^[a-z]$/i.test(key);
  const name = letter ? key.toUpperCase() : key === " " ? "Space" : key;
  return [
    (ctrlKey || metaKey) && "Ctrl", altKey && "Alt", shiftKey && (letter || key.length > 1) && "Shift",
    name,
  ].filter(Boolean).join("+");
}

// Whether people have asked for less to move.
export const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

// Who wants to know of a change: b.heard(ear); b.ring(what).
export function bell() {
  const ears = new Set();
  return { heard: (ear) => ears.add(ear), ring: (what) => [...ears].forEach((ear) => ear(what)) };
}

// Runs at most once a frame.
export function framed(run) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      run();
    });
  };
}

const ICONS = {
  undo: "M8 5L4 9l4 4M4 9h9a6 6 0 010 12h-3",
  redo: "M16 5l4 4-4 4M20 9h-9a6 6 0 000 12h3",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  tidy: "M4 5h6v5H4zM14 3h6v5h-6zM14 16h6v5h-6zM10 7.5h4M10 7.5h2v11h2",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  play: "M8 5l11 7-11 7z",
  pause: "M9 5v14M15 5v14",
  back: "M18 6l-8 6 8 6zM6 6v12",
  build: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9",
  moon: "M20 14.5A8.5 8.5 0 019.5 4a8.5 8.5 0 1010.5 10.5z",
  sun: "M12 8a4 4 0 110 8 4 4 0 010-8zM12 2v2.5M12 19.5V22M2 12h2.5M19.5 12H22M5 5l1.7 1.7M17.3 17.3L19 19M5 19l1.7-1.7M17.3 6.7L19 5",
  help: "M12 3a9 9 0 110 18 9 9 0 010-18zM9.5 9.5a2.5 2.5 0 113.6 2.2c-.8.4-1.1.9-1.1 1.8M12 16.6v.2",
  warning: "M12 4L2.5 20h19zM12 10v5M12 17.4v.3",
  bad: "M12 3a9 9 0 110 18 9 9 0 010-18zM9 9l6 6M15 9l-6 6",
  good: "M12 3a9 9 0 110 18 9 9 0 010-18zM8 12l3 3 5-6",
  info: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 11v6M12 7v.3",
  close: "M6 6l12 12M18 6L6 18",
  search: "M10.5 4a6.5 6.5 0 110 13 6.5 6.5 0 010-13zM15.5 15.5L20.5 20.5",
  chevron: "M9 6l6 6-6 6",
  trash: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  code: "M8 7l-5 5 5 5M16 7l5 5-5 5",
  path: "M5 19a2 2 0 100-4 2 2 0 000 4zM19 9a2 2 0 100-4 2 2 0 000 4zM7 17h6a4 4 0 000-8h-2a3 3 0 010-2h6",
  wire: "M4 12h12M12 7l5 5-5 5",
  saved: "M6 12.5l4 4 8-9",
  fix: "M14 6a4.5 4.5 0 016-1l-3.2 3.2 1 2 2 1L23 8a4.5 4.5 0 01-6 5.6L9 21.5 4.5 17z",
};

// A sign beside words, never instead of them.
export const icon = (name, size = 18) => svg("svg", {
  viewBox: "0 0 24 24", width: size, height: size, fill: "none", stroke: "currentColor",
  "stroke-width": 1.8, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": "true",
}, svg("path", { d: ICONS[name] }));

export const button = (text, onclick, { kind = "", sign = "", ...props } = {}) =>
  h("button", { type: "button", class: `button ${kind}`, onclick, ...props },
    sign && icon(sign), h("span", {}, text));

// A button with a sign only; its name is read aloud, and shown when pointed at.
export const signButton = (name, onclick, sign, props = {}) =>
  h("button", {
    type: "button", class: "button quiet sign", onclick, "aria-label": name, title: name, ...props,
  }, icon(sign));

export const status = (name, props = {}) =>
  h("span", { class: "status", "data-status": name, ...props }, name);
