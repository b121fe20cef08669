// Changing the order of a list's children by dragging: with the mouse anywhere on one, with a finger
// on its grip, as elsewhere a finger scrolls. Escape lets go.

import { h } from "./dom.js";

export function reorderable(list, moved) {
  const line = h("div", { class: "drop-line" });
  const items = () => [...list.children].filter((item) => item !== line);
  let drag = null;

  function end(commit) {
    if (!drag) return;
    const { item, from, to } = drag;
    drag = null;
    item.classList.remove("dragged");
    item.style.transform = "";
    line.remove();
    window.removeEventListener("keydown", escape, true);
    if (commit && to !== from) moved(from, to);
  }
  const escape = ({ key }) => key === "Escape" && end(false);

  list.addEventListener("pointerdown", ({ target, pointerType, pointerId, button, clientY }) => {
    const from = items().findIndex((item) => item.contains(target));
    if (from < 0 || button || target.closest("button, input, select, a")) return;
    if (pointerType !== "mouse" && !target.closest(".grip")) return;
    drag = { item: items()[from], from, to: from, y: clientY, id: pointerId };
  });
  list.addEventListener("pointermove", ({ clientY: y }) => {
    if (!drag || (!line.isConnected && Math.abs(y - drag.y) < 6)) return; // still a click
    if (!line.isConnected) {
      list.setPointerCapture(drag.id);
      drag.item.classList.add("dragged");
      list.append(line);
      window.addEventListener("keydown", escape, true);
    }
    const others = items().filter((item) => item !== drag.item).map((item) =>
      item.getBoundingClientRect());
    const { top, bottom } = list.getBoundingClientRect();
    const at = others.findIndex((box) => y < box.top + box.height / 2);
    drag.to = at < 0 ? others.length : at;
    const edge = others[at]?.top ?? others.at(-1)?.bottom ?? top;
    drag.item.style.transform = `translateY(${y - drag.y}px)`;
    line.style.top = `${edge - top + list.scrollTop}px`;
    list.scrollTop += y < top + 24 ? -8 : y > bottom - 24 ? 8 : 0;
  });
  list.addEventListener("pointerup", () => end(true));
  list.addEventListener("pointercancel", () => end(false));
}
