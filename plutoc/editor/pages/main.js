import { voices } from "./announce.js";
import { makeCanvas } from "./canvas/canvas.js";
import { h } from "./dom.js";
import { open } from "./link.js";
import { makeOutline } from "./panes/outline.js";
import { makePalette } from "./panes/palette.js";

const shell = h("div", { class: "shell" },
  h("header", { class: "bar" }, h("h1", {}, "x")),
  h("div", { class: "left" }, makePalette(), makeOutline()),
  makeCanvas({ quick() {}, properties() {} }),
  h("div", { class: "below" }), h("div", { class: "side" }));
document.body.append(shell, ...voices);
open();
