// What happens to the files elsewhere: merged, contradicting, gone, not to be written.

import { refused, tell } from "../announce.js";
import { button, h, icon, put, shown } from "../dom.js";
import { ask, linked, lost, pushes } from "../link.js";
import { app, begun } from "../state.js";
import { showDialog } from "../dialogs/dialog.js";

export function makeConflicts() {
  const words = h("p", {});
  const tools = h("div", { class: "row spread" });
  const bar = h("div", { class: "conflict", role: "alert", hidden: true }, icon("warning"), words, tools);
  let line = false;

  function show(text, ...buttons) {
    put(words, text);
    tools.replaceChildren(...buttons);
    shown(bar, true);
  }

  const hide = () => shown(bar, false);
  const keep = (push, which) => ask("resolve", { keep: which, file: push.file }).then(hide, refused);

  pushes.heard((push) => {
    const file = push.file === "hooks" ? "hooks.py" : app.file;
    if (push.push === "cannot_save") {
      show(`${push.why ?? "The file cannot be written."} Nothing is lost: it is kept here, and tried again.`);
    } else if (push.push === "disk" && push.what === "conflict") {
      show(`${file} was changed elsewhere, in the same place as here. Nothing is saved until you choose.`,
        button("Show both", () => both(push), { kind: "small" }),
        button("Keep mine", () => keep(push, "ours"), { kind: "small" }),
        button("Take theirs", () => keep(push, "theirs"), { kind: "small" }));
    } else if (push.push === "disk" && push.what === "gone") {
      show(`${file} was removed elsewhere. It is written again with your next change.`, button("All right", hide, { kind: "small" }));
    } else if (push.push === "disk" && push.what === "merged") {
      tell(`${file} was changed elsewhere: both changes are in it now.`);
    } else if (push.push === "disk" && ["saved", "resolved"].includes(push.what)) {
      if (!bar.hidden && !line) hide();
    }
  });
  linked.heard((yes) => {
    line = !yes;
    if (line) show(lost.why);
  });
  begun.heard(() => { line = false; hide(); });
  return bar;

  function both({ ours, theirs }) {
    showDialog({
      title: "Both texts", kind: "wide",
      content: h("div", { class: "both" },
        h("section", {}, h("h3", {}, "Mine"), h("pre", { tabIndex: 0 }, ours ?? app.text)),
        h("section", {}, h("h3", {}, "Theirs"), h("pre", { tabIndex: 0 }, theirs ?? ""))),
    });
  }
}
