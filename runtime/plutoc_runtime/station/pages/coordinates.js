// Where a trip goes, in numbers: x and y, and the height where it is not the usual one.
//
//   const where = coordinates(app.map, (target, typing) => …);
//   where.element   where.height (an element of its own)   where.update(target, problem, locked)

import { h, put, set, shown, unique } from "./dom.js";
import { icon } from "./dom.js";
import { number, read } from "./numbers.js";

export function coordinates(map, change) {
  let target = null;
  const x = metres("x", "x (m)", () => tell(), () => target?.[0]);
  const y = metres("y", "y (m)", () => tell(), () => target?.[1]);
  const z = metres("z", "Height (m)", () => tell(), () => target?.[2]);
  z.input.placeholder = number(map.cruise_height);
  const words = h("span", {});
  const problem = h("p", { class: "problem", id: unique("place-problem"), hidden: true },
    icon("warning"), words);
  for (const { input } of [x, y]) set(input, "aria-describedby", problem.id);
  const element = h("div", { class: "coordinates" }, x.element, y.element, problem);

  function tell() {
    const now = [x, y].map(({ input }) => read(input.value));
    if (now.includes(null)) return; // it is not finished: what was there stays
    const height = read(z.input.value);
    change(height === null ? now : [...now, height], true);
  }

  return {
    element,
    height: z.element,
    focus: () => x.input.focus(),
    update(now, text, locked) {
      target = now;
      for (const field of [x, y, z]) {
        field.show();
        field.input.disabled = locked;
      }
      put(words, text);
      shown(problem, text);
      for (const { input } of [x, y]) set(input, "aria-invalid", text ? "true" : null);
    },
  };
}

function metres(name, label, tell, value) {
  const id = unique(name);
  const text = () => (typeof value() === "number" ? number(value()) : "");
  const input = h("input", {
    id, name, inputmode: "decimal", autocomplete: "off", maxlength: 12,
    oninput: tell,
    onblur: () => { input.value = text(); },
  });
  return {
    input,
    element: h("div", { class: "field", "data-field": name }, h("label", { for: id }, label), input),
    show() {
      if (document.activeElement !== input && input.value !== text()) input.value = text();
    },
  };
}
