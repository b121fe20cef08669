// A battery as a small bar with its percentage beside it.
import { h } from "./dom.js";
import { words } from "./quick.js";
import { percent } from "./standing.js";

export const level = (charge) => (charge < 0.2 ? "low" : charge < 0.4 ? "middle" : "full");

export function battery() {
  const fill = h("span", { class: "charge" });
  const text = words();
  const element = h(
    "span",
    { class: "battery full" },
    h("span", { class: "charge-box", "aria-hidden": "true" }, fill),
    text.node,
  );
  let shown;
  const show = (charge) => {
    const whole = charge === null ? null : Math.round(charge * 100);
    if (whole === shown) return;
    shown = whole;
    element.hidden = whole === null;
    if (whole === null) return;
    fill.style.width = `${whole}%`;
    element.className = `battery ${level(charge)}`;
    text.show(percent(charge));
  };
  show(null);
  return { element, show };
}
