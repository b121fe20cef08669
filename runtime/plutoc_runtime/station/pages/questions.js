// What only a person can know: shown first and loudly, with its answers as buttons.
import { h } from "./dom.js";
import { sureButton } from "./sure.js";

const ANSWERS = {
  done: "It was done",
  "not-done": "It was not done",
  "go-on": "Go on",
};

// The question of one mission with its answers.
export function question(context, row) {
  const { name: mission, question: asked } = row;
  const buttons = asked.answers.map((answer) => {
    const decide = () => context.tell("decide", { mission, answer });
    if (answer === "cancel") {
      return sureButton("Cancel mission", "Really cancel? It ends for good", decide);
    }
    const button = h("button", { type: "button", class: "button" }, ANSWERS[answer] ?? answer);
    button.addEventListener("click", decide);
    return button;
  });
  return h(
    "div",
    { class: "m-question" },
    h("p", {}, h("strong", {}, `${mission}: `), asked.text),
    h("div", { class: "buttons" }, ...buttons),
  );
}

// All questions there are, above everything else on the page.
export function questions(context) {
  const list = h("div", { class: "list" });
  const heading = h("h2", {});
  const element = h(
    "section",
    { class: "questions", role: "alert", "aria-label": "Missions that wait for you" },
    heading,
    list,
  );
  element.hidden = true;
  const asked = new Map();
  const update = (rows) => {
    let changed = false;
    for (const row of rows) {
      const text = JSON.stringify(row.question);
      const before = asked.get(row.name);
      if ((before?.text ?? "null") === text) continue;
      changed = true;
      before?.element.remove();
      asked.delete(row.name);
      if (!row.question) continue;
      const card = question(context, row);
      asked.set(row.name, { text, element: card });
      list.append(card);
    }
    if (changed) showCount();
  };
  const showCount = () => {
    const { size } = asked;
    heading.textContent = size === 1 ? "A mission waits for you" : `${size} missions wait for you`;
    element.hidden = size === 0;
  };
  const clear = () => {
    asked.clear();
    list.replaceChildren();
    showCount();
  };
  return { element, update, clear };
}
