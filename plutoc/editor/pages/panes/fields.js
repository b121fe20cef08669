// Fields for declared values: checked as one types, sent when they are right.

import { h, put, set, shown, unique } from "../dom.js";

const LIKE = {
  int: [/^-?\d+$/, "a whole number"], float: [/^-?\d+(\.\d+)?$/, "a number"],
};

// Why a value cannot be what is declared; "" where it can.
function wrongIn(argument, text) {
  const value = text.trim();
  if (!value) return argument.required && argument.default === null ? "A value is needed here." : "";
  if (argument.choices || argument.type === "text") return "";
  const { units, type } = argument;
  if (units.length) {
    const found = /^-?\d+(?:\.\d+)?\s*(\S*)$/.exec(value);
    if (!found) return `Write a number and a unit, such as 3 ${units.at(-1)}.`;
    if (!found[1]) return `A unit is missing: ${units.map((unit) => `${value} ${unit}`).join(", ")}.`;
    if (!units.includes(found[1])) {
      return `“${found[1]}” is no unit of ${/^[aeiou]/.test(type) ? "an" : "a"} ${type}: ${units.join(", ")}.`;
    }
    return "";
  }
  const [fits, words] = LIKE[type] ?? [];
  return fits && !fits.test(value) ? `This must be ${words}.` : "";
}

const unquoted = (text) => (/^".*"$/.test(text) ? JSON.parse(text) : text);

const written = (argument, text) => {
  const value = text.trim();
  if (!value) return null;
  return argument.type === "text" ? JSON.stringify(unquoted(value)) : value;
};

// → { element, update(argument) }; send(value as it is written, or null)
export function fieldOf(first, send) {
  let argument = first;
  const id = unique("field");
  const problem = h("p", { class: "field-problem", id: `${id}-why`, role: "alert", hidden: true });
  const doc = h("p", { class: "hint", id: `${id}-doc` });
  const input = first.choices ? h("select", { id, onchange: () => send(input.value || null) })
    : h("input", { id, type: "text", spellcheck: "false", autocomplete: "off", oninput: check, onchange: commit, onkeydown: keys });
  set(input, "aria-describedby", `${id}-doc ${id}-why`);

  const shownValue = () => unquoted(argument.written ?? "");

  function check() {
    const why = wrongIn(argument, input.value);
    put(problem, why);
    shown(problem, why);
    set(input, "aria-invalid", why ? "true" : null);
    return !why;
  }

  function commit() {
    if (!check() || input.value.trim() === shownValue()) return;
    send(written(argument, input.value));
  }

  function keys(event) {
    if (event.key === "Enter") commit();
    if (event.key !== "Escape") return;
    input.value = shownValue();
    check();
  }

  function update(next) {
    argument = next;
    put(doc, [next.doc, !next.choices && next.units.length ? `In ${next.units.join(", ")}.` : ""].filter(Boolean).join(" "));
    if (next.choices) {
      const none = next.default !== null ? `${next.default} (default)` : next.required ? "choose one …" : "none";
      const options = ["", ...next.choices];
      if (input.dataset.options !== options.join() + none) {
        input.dataset.options = options.join() + none;
        input.replaceChildren(...options.map((one) => h("option", { value: one }, one || none)));
      }
      input.value = next.written ?? "";
    } else {
      input.placeholder = next.default ?? (next.units.length ? `such as 3 ${next.units.at(-1)}` : "");
      if (document.activeElement !== input) {
        input.value = shownValue();
        check();
      }
    }
  }

  update(first);
  const element = h("div", { class: "field", "data-field": first.name },
    h("label", { for: id }, first.name.replaceAll("_", " "), first.of_hook && h("span", { class: "hint" }, " of the hook")),
    input, problem, doc);
  return { element, update };
}
