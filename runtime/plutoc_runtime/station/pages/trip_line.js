// A trip of an opened mission: where it stands, its priority, and the button that leaves it out.
import { h } from "./dom.js";
import { attribute, visible, words } from "./quick.js";
import { sign, tone } from "./signs.js";
import { metres, spoken, tripWord } from "./standing.js";

export function tripLine(name, send, priorities) {
  const [number, what, status, weight] = Array.from({ length: 4 }, () => words());
  const mark = sign();
  let priority = 1;
  const step = (by, sign_, label) => {
    const text = `${label} the priority of trip ${name}`;
    const button = h("button", { type: "button", class: "m-step", "aria-label": text }, sign_);
    button.addEventListener("click", () =>
      send("prioritise", { trip: name, priority: priority + by }),
    );
    return button;
  };
  const less = step(-1, "−", "Lower");
  const priorityParts = [
    h("span", { class: "m-label" }, "Priority"),
    less,
    h("output", { class: "m-value" }, weight.node),
    step(1, "+", "Raise"),
  ];
  const stepper = h("span", { class: "m-stepper" }, ...priorityParts);
  const skip = h(
    "button",
    { type: "button", class: "button quiet small", "aria-label": `Skip trip ${name}` },
    "Skip",
  );
  skip.addEventListener("click", () => send("skip", { trip: name }));
  const state = h("span", { class: "m-status" }, mark.element, status.node);
  const element = h(
    "li",
    { class: "m-line" },
    h("span", { class: "m-nth" }, number.node),
    h("span", { class: "m-trip" }, name, h("span", { class: "m-what" }, what.node)),
    state,
    h("span", { class: "m-acts" }, stepper, skip),
  );
  const write = {
    tone: attribute(state, "data-tone"),
    current: attribute(element, "aria-current"),
    stepper: visible(stepper),
    skip: visible(skip),
  };
  const show = ([, standing, x, y, weighs, action], { index, current, ended }) => {
    priority = weighs ?? 1;
    number.show(`${index + 1}.`);
    what.show(`${spoken(action)} at ${metres(x)}, ${metres(y)}`);
    status.show(tripWord(standing));
    mark.show(standing);
    write.tone(tone(standing));
    write.current(current ? "step" : null);
    const open = !ended && standing !== "COMPLETED" && standing !== "SKIPPED";
    weight.show(String(priority));
    write.stepper(open && priorities && weighs !== null);
    write.skip(open);
  };
  return { element, show };
}
