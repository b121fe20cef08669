// What the app's evaluators said of the missions, newest first.
import { h } from "./dom.js";
import { clock } from "./dom.js";

const SHOWN = 200;

export function verdicts(chosen) {
  const list = h("ul", { class: "verdicts" });
  const empty = h("p", { class: "empty" }, "No mission has been judged yet.");
  const element = h("div", {}, empty, list);
  const line = ([, time, mission, , round, , , , text]) => {
    const pick = h("button", { type: "button", class: "link" }, mission);
    pick.addEventListener("click", () => chosen.set(mission));
    const when = h("span", { class: "m-when" }, clock(time));
    const of = h("span", {}, pick, round > 1 ? `, round ${round}` : "");
    return h("li", {}, when, of, h("span", { class: "m-text" }, String(text)));
  };
  const update = (entries) => {
    list.prepend(...entries.slice(-SHOWN).map(line).reverse());
    while (list.childElementCount > SHOWN) list.lastElementChild.remove();
    empty.hidden = true;
  };
  const clear = () => {
    list.replaceChildren();
    empty.hidden = false;
  };
  return { element, update, clear };
}
