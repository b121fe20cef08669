// What compiling would change is shown first, file by file; then it is written.

import { refused, say, tell } from "../announce.js";
import { button, h, many, set } from "../dom.js";
import { ask } from "../link.js";
import { typedAll } from "../text/pane.js";
import { showDialog } from "./dialog.js";

const SIGNS = { new: "new", changed: "changed", deleted: "deleted", same: "as it was" };

// What will change comes first, and the app's own code before what every package carries.
const rank = ({ path, status }) =>
  4 * (status === "same") + 2 * path.includes("/_runtime/") + !/\/(flow|model|hooks)\.py$/.test(path);

const toneOf = (line) => {
  if (/^(diff|index|new file|deleted file|---|\+\+\+)/.test(line)) return "about";
  return { "+": "plus", "-": "minus", "@": "about" }[line[0]] ?? "";
};

export async function compile() {
  say("Compiling …");
  try {
    await typedAll();
    const found = await ask("compile", { write: false });
    show(found);
  } catch (error) {
    refused(error);
  }
}

function show({ files, meaning, folder }) {
  const changed = files.filter(({ status }) => status !== "same");
  const view = h("pre", { class: "diff", tabIndex: 0, "aria-label": "Difference" });
  const list = h("ul", { class: "files", role: "listbox", tabIndex: 0, "aria-label": "Files of the package", onkeydown: keys });
  let at = 0;
  files.sort((a, b) => rank(a) - rank(b) || a.path.localeCompare(b.path));
  list.append(...files.map((file, i) => h("li", { role: "option", id: `file-${i}`, onclick: () => open(i), "data-what": file.status },
    h("span", { class: "file-name" }, file.path), h("span", { class: "file-status" }, SIGNS[file.status] ?? file.status))));
  const write = button(changed.length ? `Write ${many(changed.length, "file")}` : "Nothing to write", async () => {
    if (!changed.length) return;
    try {
      await ask("compile", { write: true });
      close();
      tell(`The package is written to ${folder}.`, { kind: "good" });
    } catch (error) {
      close();
      refused(error);
    }
  }, { kind: "primary" });
  if (!changed.length) set(write, "aria-disabled", "true");
  const { close } = showDialog({
    title: "Compile: what will change", kind: "wide compile",
    content: [
      h("p", { class: "hint" }, `Into the folder ${folder}. `, changed.length ? `${many(changed.length, "file")} of ${files.length} will change.` : "The package is what the source says."),
      meaning.length > 0 && h("ul", { class: "meaning" }, meaning.map((one) => h("li", {}, one))),
      h("div", { class: "compile-split" }, list, view),
    ],
    buttons: [button("Cancel", () => close()), write], focus: write,
  });
  open(0);

  function open(i) {
    at = i;
    [...list.children].forEach((item, j) => set(item, "aria-selected", String(i === j)));
    set(list, "aria-activedescendant", `file-${i}`);
    list.children[i]?.scrollIntoView({ block: "nearest" });
    const lines = (files[i]?.diff || "No difference.").split("\n");
    view.replaceChildren(...lines.map((line) => h("span", {
      class: toneOf(line),
    }, `${line}\n`)));
  }

  function keys(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    open(Math.min(files.length - 1, Math.max(0, at + by)));
  }
}
