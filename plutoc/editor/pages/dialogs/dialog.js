// A window over the page: the browser keeps the focus in it, and Escape closes it.

import { h, signButton, unique } from "../dom.js";

// → { dialog, closed: promise, close }
export function showDialog({ title, content, buttons = [], kind = "", at = null, focus = null }) {
  const id = unique("title");
  const close = () => dialog.close();
  const dialog = h("dialog", { class: `dialog ${kind}`, "aria-labelledby": id },
    h("div", { class: "dialog-head" }, h("h2", { id }, title), signButton("Close", close, "close")),
    h("div", { class: "dialog-body", tabIndex: kind.includes("wide") ? 0 : null }, content),
    buttons.length > 0 && h("div", { class: "dialog-foot" }, buttons));
  document.body.append(dialog);
  dialog.showModal();
  if (at) {
    const { width, height } = dialog.getBoundingClientRect();
    dialog.classList.add("placed");
    dialog.style.left = `${Math.max(8, Math.min(at[0] - width / 2, innerWidth - width - 8))}px`;
    dialog.style.top = `${Math.max(8, Math.min(at[1] - 8, innerHeight - height - 8))}px`;
  }
  dialog.addEventListener("pointerdown", (event) => { if (event.target === dialog) close(); });
  focus?.focus();
  const closed = new Promise((resolve) => {
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve();
    });
  });
  return { dialog, closed, close };
}
