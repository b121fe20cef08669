// Elements in one expression, and lists that keep their elements. Text only ever becomes text
// nodes.
//
//   h("button", { class: "primary", onclick: start, disabled: true }, "Start ", 3, " missions")
//   svg("circle", { cx: 1, cy: 2, r: 0.2 })
//   keyed(list, missions, (m) => m.key, make, update)
//                              // make(item) → element, update(element, item, i)
//   put(cell, "3 of 5")        // sets the text, if it is another
//   set(row, "hidden", true)   // sets an attribute, if it is another; null or false removes it

const PROPERTIES = new Set(["value", "checked", "disabled", "hidden", "selected", "tabIndex"]);

function build(node, props, children) {
  for (const [name, value] of Object.entries(props ?? {})) {
    if (typeof value === "function") node.addEventListener(name.slice(2), value);
    else if (PROPERTIES.has(name) && name in node) node[name] = value;
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) {
      node.setAttribute(name, value);
    }
  }
  node.append(...kept(children));
  return node;
}

function kept(children) {
  return children.flat(3).filter((child) => ![null, undefined, false].includes(child));
}

export function h(tag, props, ...children) {
  return build(document.createElement(tag), props, children);
}

export function svg(tag, props, ...children) {
  return build(document.createElementNS("http://www.w3.org/2000/svg", tag), props, children);
}

// New children for an element.
export function fill(node, ...children) {
  node.replaceChildren(...kept(children));
  return node;
}

export function put(node, text) {
  const now = String(text);
  if (node.textContent !== now) node.textContent = now;
  return node;
}

export function set(node, name, value) {
  if (value === null || value === undefined || value === false) {
    if (node.hasAttribute(name)) node.removeAttribute(name);
  } else if (node.getAttribute(name) !== String(value)) {
    node.setAttribute(name, String(value));
  }
  return node;
}

// Shows or hides an element.
export function shown(node, yes) {
  if (node.hidden === Boolean(yes)) node.hidden = !yes;
  return node;
}

const MADE = new WeakMap(); // parent → Map of key → element

// Makes the children of `parent` those of `items`, in their order. An element stays the same as
// long as its key is there, so that focus, selection and transitions survive.
export function keyed(parent, items, key, make, update) {
  const before = MADE.get(parent) ?? new Map();
  const now = new Map();
  const focused = parent.contains(document.activeElement) ? document.activeElement : null;
  items.forEach((item, i) => {
    const node = before.get(key(item)) ?? make(item);
    now.set(key(item), node);
    update?.(node, item, i);
    if (parent.children[i] !== node) parent.insertBefore(node, parent.children[i] ?? null);
  });
  while (parent.children.length > items.length) parent.lastElementChild.remove();
  MADE.set(parent, now);
  if (focused && focused !== document.activeElement && parent.contains(focused)) focused.focus();
}

let last = 0;

// An id for labels and descriptions.
export function unique(stem) {
  last += 1;
  return `${stem}-${last}`;
}
