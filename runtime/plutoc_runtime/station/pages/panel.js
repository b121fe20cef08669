// A part of the page with a heading that folds it away; what was folded stays so.
import { h } from "./dom.js";

const remembered = (key) => {
  try {
    return localStorage.getItem(key) === "folded";
  } catch {
    return false; // a browser that keeps nothing
  }
};

const remember = (key, folded) => {
  try {
    localStorage.setItem(key, folded ? "folded" : "open");
  } catch {
    // it will be open the next time
  }
};

// tools: what stands beside the heading. changed(open) is called when it is folded or opened.
export function panel(name, title, { tools = [], body = [], changed = () => {} } = {}) {
  const key = `pluto.panel.${name}`;
  const toggle = h("button", { type: "button", class: "fold", "aria-controls": `${name}-body` });
  const arrow = h("span", { class: "arrow", "aria-hidden": "true" });
  toggle.append(arrow, title);
  const beside = h("div", { class: "tools" }, ...tools);
  const inside = h("div", { class: "inside", id: `${name}-body` }, ...body);
  const element = h(
    "section",
    { class: `panel ${name}`, "aria-labelledby": `${name}-title` },
    h("div", { class: "m-bar" }, h("h2", { id: `${name}-title` }, toggle), beside),
    inside,
  );
  const fold = (folded) => {
    element.classList.toggle("folded", folded);
    toggle.setAttribute("aria-expanded", String(!folded));
    inside.hidden = folded;
    beside.hidden = folded;
    changed(!folded);
  };
  toggle.addEventListener("click", () => {
    const folded = !element.classList.contains("folded");
    remember(key, folded);
    fold(folded);
  });
  fold(remembered(key));
  return { element, inside };
}
