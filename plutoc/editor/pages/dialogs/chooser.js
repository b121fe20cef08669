// Choose one of a list by typing a part of it: blocks to add, blocks to connect to, things to declare.

import { h, put, set, unique } from "../dom.js";
import { showDialog } from "./dialog.js";

// options: [{ id, label, detail, why }], or a promise of them: what is typed until then counts.
// What has a `why` cannot be chosen, and says so.
// → the chosen id, or null
export function choose({ title, options, at = null, placeholder = "Type to find", above = null }) {
  const listId = unique("list");
  const input = h("input", {
    type: "text", role: "combobox", "aria-expanded": "true", "aria-controls": listId, "aria-autocomplete": "list",
    "aria-label": title, placeholder, autocomplete: "off", spellcheck: "false",
    oninput: () => draw(), onkeydown: keys,
  });
  const list = h("ul", { class: "choices", role: "listbox", id: listId, "aria-label": title });
  const why = h("p", { class: "hint choice-why", role: "status" });
  let [shown, at_, chosen] = [[], 0, null];
  let all = [];
  let [waits, entered, failed] = [true, false, null];
  const { closed, close } = showDialog({
    title, kind: "chooser", at, focus: input, content: [above?.(renew), input, list, why],
  });
  if (Array.isArray(options)) renew(options);
  else options.then(renew, (error) => { failed = error; close(); });
  input.focus();
  return closed.then(() => {
    if (failed) throw failed;
    return chosen;
  });

  function renew(next) {
    [all, waits] = [next, false];
    draw();
    if (entered) take(at_);
    entered = false;
  }

  function rank({ id, label }, words) {
    const text = `${id} ${label}`.toLowerCase();
    if (text.startsWith(words) || label.toLowerCase().startsWith(words)) return 0;
    const parts = label.match(/[A-Z]?[a-z]+|\d+/g) ?? [];
    return parts.some((part) => part.toLowerCase().startsWith(words)) ? 1 : text.includes(words) ? 2 : 3;
  }

  function draw() {
    const words = input.value.trim().toLowerCase();
    shown = all.map((one) => ({ one, rank: words ? rank(one, words) : 0 }))
      .filter(({ one, rank: far }) => far < 3 || `${one.detail}`.toLowerCase().includes(words))
      .sort((a, b) => Boolean(a.one.why) - Boolean(b.one.why) || a.rank - b.rank).map(({ one }) => one);
    at_ = 0;
    list.replaceChildren(...shown.map((one, i) => h("li", {
      role: "option", id: `${listId}-${i}`, "aria-disabled": one.why ? "true" : null,
      onclick: () => take(i), onpointermove: () => { if (at_ !== i) mark(i); },
    }, h("span", { class: "choice-label" }, one.label), h("span", { class: "choice-detail" }, one.why || one.detail))));
    mark(0);
  }

  function mark(i) {
    at_ = i;
    [...list.children].forEach((item, j) => set(item, "aria-selected", String(i === j)));
    set(input, "aria-activedescendant", shown.length ? `${listId}-${i}` : null);
    list.children[i]?.scrollIntoView({ block: "nearest" });
    put(why, shown.length ? shown[i].why ?? "" : waits ? "" : "Nothing fits.");
  }

  function take(i) {
    const one = shown[i];
    if (!one || one.why) return put(why, one?.why ?? "Nothing fits.");
    chosen = one.id;
    return close();
  }

  function keys(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by && shown.length) {
      event.preventDefault();
      mark((at_ + by + shown.length) % shown.length);
    } else if (event.key === "Enter") {
      event.preventDefault();
      if (waits) entered = true;
      else take(at_);
    }
  }
}
