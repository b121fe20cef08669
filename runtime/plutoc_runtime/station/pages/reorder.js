// Changing the order of a list by dragging: with the mouse anywhere on an item, with a finger on
// its grip (elsewhere a finger scrolls). Escape lets go.
//
//   reorderable(list, (from, to) => …);   // items: the list's children; grip: class "grip"

import { h } from "./dom.js";

const START = 6; // pixels that are still a click

export function reorderable(list, moved) {
  const line = h("div", { class: "drop-line", hidden: true, "aria-hidden": "true" });
  let drag = null;

  const items = () => [...list.children].filter((item) => item !== line);

  // Before which item it would fall, of those that stay.
  function place(y) {
    const others = items().filter((item) => item !== drag.item);
    const at = others.findIndex((item) => {
      const box = item.getBoundingClientRect();
      return y < box.top + box.height / 2;
    });
    return [at < 0 ? others.length : at, others];
  }

  function show(y) {
    const [at, others] = place(y);
    const box = list.getBoundingClientRect();
    const before = others[at]?.getBoundingClientRect().top
      ?? others[others.length - 1].getBoundingClientRect().bottom;
    line.style.top = `${before - box.top + list.scrollTop - list.clientTop}px`;
    drag.to = at;
    if (y < box.top + 24) list.scrollTop -= 8;
    if (y > box.bottom - 24) list.scrollTop += 8;
  }

  function end(commit) {
    if (!drag) return;
    const { item, from, to, going } = drag;
    drag = null;
    item.classList.remove("dragged");
    item.style.transform = "";
    line.remove();
    window.removeEventListener("keydown", escape, true);
    if (commit && going && to !== from) moved(from, to);
  }

  function escape(event) {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    end(false);
  }

  list.addEventListener("pointerdown", (event) => {
    const item = items().find((each) => each.contains(event.target));
    const touched = event.pointerType !== "mouse" && !event.target.closest(".grip");
    if (!item || event.button !== 0 || touched || items().length < 2) return;
    if (event.target.closest("button, input, select, a")) return;
    const from = items().indexOf(item);
    drag = { item, from, to: from, y: event.clientY, id: event.pointerId, going: false };
  });
  list.addEventListener("pointermove", (event) => {
    if (!drag || event.pointerId !== drag.id) return;
    const by = event.clientY - drag.y;
    if (!drag.going) {
      if (Math.abs(by) < START) return;
      drag.going = true;
      list.setPointerCapture(drag.id);
      drag.item.classList.add("dragged");
      line.hidden = false;
      list.append(line);
      window.addEventListener("keydown", escape, true);
    }
    event.preventDefault();
    drag.item.style.transform = `translateY(${by}px)`;
    show(event.clientY);
  });
  list.addEventListener("pointerup", () => end(true));
  list.addEventListener("pointercancel", () => end(false));
}
