// What would be put down here: a pin that goes along with an action that is dragged or in hand, and
// says while it does whether it may be there.

import { set, svg } from "./dom.js";
import { name, pinWords } from "./pin_words.js";
import { whyNot } from "./places.js";

export function ghostPin(floor, map) {
  const words = pinWords();
  const pin = svg("g", { class: "pin ghost-pin" }, svg("circle", { class: "disc", r: 12.5 }),
    svg("text", { class: "pin-number", y: 4.5 }, "+"), words);
  const mark = floor.mark(0, 0, pin);

  return {
    /** Above all other layers that there are by now. */
    raise: () => floor.layer("ghost").append(mark),
    show(action, target) {
      set(mark, "display", target ? null : "none");
      if (!target) return;
      floor.move(mark, target[0], target[1]);
      const trouble = whyNot(map, target);
      set(pin, "class", `pin ghost-pin${trouble ? " bad" : ""}`);
      name(words, trouble || `${target[0]}, ${target[1]} m`, { floor, target });
    },
  };
}
