// Below the graph: problems, and a run. Folded away, it leaves a line.

import { h, put, set, shown, signButton } from "../dom.js";
import { app, begun, changed } from "../state.js";

const TABS = ["problems", "run"];
const WORDS = { problems: "Problems", run: "Run" };

let show = () => {};
export const showBelow = (name) => show(name);

export function makeBelow(panels, aside) {
  const tabs = {};
  const fold = signButton("Fold", () => open(!body.hidden ? null : current), "chevron", { class: "button quiet sign small fold" });
  let current = TABS[0];
  for (const name of TABS) {
    tabs[name] = h("button", {
      type: "button", role: "tab", class: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}`,
      onclick: () => open(name), onkeydown: (event) => {
        if (!["ArrowLeft", "ArrowRight"].includes(event.key)) return;
        event.preventDefault();
        open(TABS[1 - TABS.indexOf(name)]);
        tabs[current].focus();
      },
    }, WORDS[name], h("span", { class: "count", hidden: true }));
    Object.assign(panels[name], { id: `panel-${name}` });
    panels[name].setAttribute("role", "tabpanel");
    panels[name].setAttribute("aria-labelledby", `tab-${name}`);
  }
  const body = h("div", { class: "below-body" }, TABS.map((name) => panels[name]));
  const element = h("section", { class: "below", "aria-label": "Problems and runs" },
    h("div", { class: "head tabbed" }, h("div", { class: "tabs", role: "tablist", "aria-label": "Below the graph" }, tabs.problems, tabs.run),
      h("div", { class: "spread row" }, aside, fold)), body);

  function open(name) {
    shown(body, name);
    set(fold, "aria-expanded", String(Boolean(name)));
    set(fold, "aria-label", name ? "Fold" : "Unfold");
    current = name ?? current;
    for (const one of TABS) {
      shown(panels[one], one === current);
      set(tabs[one], "aria-selected", String(one === current));
      tabs[one].tabIndex = one === current ? 0 : -1;
    }
    shown(aside, current === "run");
  }

  function count() {
    const { problems } = app.view;
    const [badge] = tabs.problems.getElementsByClassName("count");
    shown(badge, problems.length);
    put(badge, problems.length);
    badge.className = `count ${problems.some((one) => one.severity === "error") ? "bad" : "warn"}`;
  }

  show = open;
  open(null);
  begun.heard(count);
  changed.heard(count);
  return element;
}
