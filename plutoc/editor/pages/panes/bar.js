// The bar: what the app is, whether it is saved, and what can be done.

import { bound } from "../commands.js";
import { h, icon, put, svg } from "../dom.js";
import { linked, pushes } from "../link.js";
import { app, begun, changed } from "../state.js";
import { showBelow } from "./below.js";

const mark = () => svg("svg", { viewBox: "0 0 32 32", width: 28, height: 28, "aria-hidden": "true", fill: "none", stroke: "currentColor", "stroke-width": 2.4, "stroke-linecap": "round" },
  svg("circle", { cx: 7, cy: 16, r: 4 }), svg("circle", { cx: 25, cy: 8, r: 4 }), svg("circle", { cx: 25, cy: 24, r: 4 }),
  svg("path", { d: "M11 15c5-1 5-6 10-6.6M11 17c5 1 5 6 10 6.6" }));

const signOf = (id, sign) => bound(h("button", { type: "button", class: "button quiet sign" }, icon(sign)), id);
const wordsOf = (id, words, sign, kind = "") =>
  bound(h("button", { type: "button", class: `button ${kind}` }, icon(sign), h("span", {}, words)), id);

export function makeBar() {
  const title = h("h1", {});
  const file = h("span", {});
  const saved = h("span", { class: "saved" });
  const found = h("button", { type: "button", class: "found", onclick: () => showBelow("problems") });
  let standing = "saved";

  function draw() {
    put(title, app.view.title || app.view.app || app.file);
    put(file, `${app.file} · `);
    document.title = `${app.view.title || app.file} – Pluto editor`;
    const errors = app.view.problems.filter((one) => one.severity === "error").length;
    const warnings = app.view.problems.length - errors;
    found.replaceChildren(...[
      errors ? h("span", { class: "bad" }, icon("bad", 16), errors, h("span", { class: "unseen" }, errors === 1 ? " error" : " errors")) : null,
      warnings ? h("span", { class: "warn" }, icon("warning", 16), warnings, h("span", { class: "unseen" }, warnings === 1 ? " warning" : " warnings")) : null,
      !errors && !warnings ? h("span", { class: "good" }, icon("good", 16), "Sound") : null,
    ].filter(Boolean));
  }

  function drawSaved() {
    const words = { saved: "Saved", saving: "Saving …", lost: "No server", failed: "Not saved" }[standing];
    saved.replaceChildren(words);
    saved.dataset.standing = standing;
  }

  begun.heard(() => { standing = "saved"; draw(); drawSaved(); });
  changed.heard(({ by }) => { // by 0: the disk
    if (by && standing !== "failed") standing = "saving";
    draw();
    drawSaved();
  });
  pushes.heard((push) => {
    if (push.push === "cannot_save") standing = "failed";
    else if (push.push === "disk" && push.what === "saved") standing = "saved";
    else return;
    drawSaved();
  });
  linked.heard((yes) => { if (!yes) { standing = "lost"; drawSaved(); } });
  const rule = () => h("span", { class: "rule", "aria-hidden": "true" });
  return h("header", { class: "bar" },
    h("div", { class: "brand" }, mark(), h("div", {}, title, h("p", {}, file, saved))),
    rule(), h("div", { class: "row tools", role: "toolbar", "aria-label": "Edit" },
      signOf("undo", "undo"), signOf("redo", "redo"), rule(), wordsOf("add", "Add", "plus", "quiet"),
      signOf("connect", "wire"), signOf("duplicate", "copy"), signOf("remove", "trash"), rule(),
      wordsOf("tidy", "Tidy", "tidy", "quiet")),
    h("div", { class: "spread" }, found, signOf("theme", "moon"), signOf("help", "help"),
      wordsOf("compile", "Compile", "build"), wordsOf("run", "Run", "play", "primary")));
}
