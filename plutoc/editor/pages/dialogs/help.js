// All keys, made of the table of commands.

import { commands } from "../commands.js";
import { h, keysShown } from "../dom.js";
import { showDialog } from "./dialog.js";

const BY_HAND = [
  ["Arrow down, up", "along an edge to the next block, and back"],
  ["Arrow left, right", "to the block beside; on an edge: to the next edge"],
  ["Alt+Arrows", "move what is selected; with Shift farther"],
  ["E", "from a block to its edges"],
  ["Enter", "properties of the block or edge"],
  ["Escape", "back to the graph; select nothing"],
];
const BY_MOUSE = [
  ["Double click", "add a block there; on a block: its properties"],
  ["Drag from a port", "draw an edge; let go in the open: add a block"],
  ["Drag on the ground", "select by a box; with Shift: more"],
  ["Wheel", "move the view; with Ctrl: zoom"],
  ["Middle or right button, Space", "drag the view"],
  ["Drag onto an edge", "put a block in between"],
];

const rows = (all) => all.map(([keys, words]) => h("div", { class: "help-row" },
  h("dt", {}, keys.split(", ").map((key) => [h("kbd", { class: "key" }, keysShown(key)), " "])), h("dd", {}, words)));

export function showHelp() {
  const keyed = commands().filter(({ keys }) => keys.length);
  showDialog({
    title: "Keys and gestures", kind: "wide help",
    content: h("div", { class: "help-columns" },
      h("section", {}, h("h3", {}, "Commands"), h("dl", {}, rows(keyed.map(({ keys, title }) => [keys.slice(0, 2).join(", "), title])))),
      h("section", {}, h("h3", {}, "In the graph"), h("dl", {}, rows(BY_HAND)), h("h3", {}, "With the mouse"), h("dl", {}, rows(BY_MOUSE)))),
  });
}
