// A button for what cannot be undone: the first press asks in place, the second one does it.
import { h } from "./dom.js";

const WAITS = 6000;

export function sureButton(label, question, act) {
  let timer = null;
  const button = h("button", { type: "button", class: "button quiet small" }, label);
  const calm = () => {
    clearTimeout(timer);
    timer = null;
    button.textContent = label;
    button.classList.remove("really");
  };
  button.addEventListener("click", () => {
    if (timer !== null) {
      calm();
      act();
      return;
    }
    button.textContent = question;
    button.classList.add("really");
    timer = setTimeout(calm, WAITS);
  });
  button.addEventListener("blur", calm);
  return button;
}
