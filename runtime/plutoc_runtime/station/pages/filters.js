// Which missions the table shows: by how they stand, with how many there are, and by name.
import { h } from "./dom.js";
import { words } from "./quick.js";
import { hasEnded, needsYou } from "./standing.js";

const KINDS = [
  ["all", "All", () => true],
  ["under-way", "Under way", (row) => !hasEnded(row) && !needsYou(row)],
  ["waiting", "Waiting for you", needsYou],
  ["failed", "Failed", (row) => row.status === "FAILED"],
];
const MANY = 12; // so many missions before one wants to look for one by its name

export function filters(changed) {
  let [, , test] = KINDS[0];
  const find = h("input", {
    type: "search",
    class: "find",
    placeholder: "Find a mission",
    "aria-label": "Find a mission by its name",
  });
  find.hidden = true;
  find.addEventListener("input", changed);
  const chips = KINDS.map(([name, label, passes], index) => {
    const count = words("0");
    const number = h("span", { class: "m-count" }, count.node);
    const button = h(
      "button",
      { type: "button", class: `sift ${name}`, "aria-pressed": String(index === 0) },
      `${label} `,
      number,
    );
    button.addEventListener("click", () => {
      test = passes;
      for (const each of chips) each.button.setAttribute("aria-pressed", String(each === chip));
      changed();
    });
    const chip = { button, count, passes };
    return chip;
  });
  const buttons = chips.map((chip) => chip.button);
  const element = h(
    "div",
    { class: "filters" },
    find,
    h("div", { class: "sifts", role: "group", "aria-label": "Show" }, ...buttons),
  );
  const count = (rows) => {
    for (const { button, count: shown, passes } of chips) {
      const number = rows.filter(passes).length;
      shown.show(String(number));
      button.classList.toggle("any", number > 0);
    }
    find.hidden = rows.length <= MANY && !find.value;
  };
  const passes = (row) =>
    test(row) && row.name.toLowerCase().includes(find.value.trim().toLowerCase());
  return { element, count, passes };
}
