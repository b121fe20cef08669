// The editor, put together: what can be done, the panes, and the line to the server.

import { say, tell, voices } from "./announce.js";
import { fitAll, makeCanvas } from "./canvas/canvas.js";
import { go } from "./canvas/keys.js";
import { zoom, zoomTo } from "./canvas/camera.js";
import { define, listenForKeys, refreshButtons } from "./commands.js";
import { compile } from "./dialogs/compile.js";
import { connectFrom } from "./dialogs/connect.js";
import { showHelp } from "./dialogs/help.js";
import { quickAdd } from "./dialogs/quick.js";
import { h } from "./dom.js";
import { Refused, linked, open } from "./link.js";
import * as operations from "./operations.js";
import { makeBar } from "./panes/bar.js";
import { makeBelow, showBelow } from "./panes/below.js";
import { makeConflicts } from "./panes/conflicts.js";
import { makeHooksAside } from "./panes/hooks.js";
import { makeOutline } from "./panes/outline.js";
import { makePalette } from "./panes/palette.js";
import { makeProblems, showProblem } from "./panes/problems.js";
import { focusProperties, makeProperties } from "./panes/properties.js";
import { makeRun, seedField, simulate } from "./panes/run.js";
import { makeSplitter } from "./panes/splitter.js";
import { END, app, begun, changed, choose, chosenBlocks, isEnd, only, selected, selection } from "./state.js";
import { focusText, hasText, makeText, toDefinition } from "./text/pane.js";

const needsBlock = () => (chosenBlocks().length ? "" : "Select a block first.");
const hasErrors = () => app.view.problems.some((one) => one.severity === "error");
const broken = () => {
  if (!app.view.blocks.length) return "There is no block yet.";
  return hasErrors() ? "The app has errors: see Problems." : "";
};

let problem = null; // none was gone to yet
function nextProblem(by) {
  const { problems } = app.view;
  problem ??= by > 0 ? -1 : 0;
  problem = (problem + by + problems.length) % problems.length;
  showBelow("problems");
  showProblem(problems[problem]);
  say(`Problem ${problem + 1} of ${problems.length}: ${problems[problem].message}`);
}

function theme() {
  const next = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  localStorage.setItem("pluto-theme", next);
  document.dispatchEvent(new Event("theme"));
  say(next === "dark" ? "Dark colours" : "Light colours");
}

function run() {
  showBelow("run");
  return simulate();
}

define(
  { id: "undo", title: "Undo", keys: ["Ctrl+Z"], where: "page", why: () => (app.history.undo ? "" : "Nothing was changed yet."), run: () => operations.undo("undo") },
  { id: "redo", title: "Redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], where: "page", why: () => (app.history.redo ? "" : "Nothing was undone."), run: () => operations.undo("redo") },
  { id: "add", title: "Add a block", keys: ["A"], run: () => quickAdd() },
  { id: "connect", title: "Connect to a block of a list", keys: ["C"], why: () => {
    if (!only()) return "Select the one block to connect from.";
    return only() === END ? "Nothing comes behind the end." : "";
  }, run: () => connectFrom(only()) },
  { id: "remove", title: "Remove", keys: ["Delete", "Backspace"], why: () => {
    if (selection.edge) return app.edges.get(selection.edge)?.implicit ? "This edge is not written: it cannot be removed." : "";
    return isEnd(only() ?? "") ? app.nodes.get(only()).event ? "Events are declared among the properties of the app." : "start and end are part of every app." : chosenBlocks().length ? "" : "Select a block or an edge first.";
  }, run: () => operations.removeSelected() },
  { id: "duplicate", title: "Duplicate", keys: ["Ctrl+D"], why: needsBlock, run: () => operations.duplicate() },
  { id: "copy", title: "Copy as Pluto text", keys: ["Ctrl+C"], why: needsBlock, run: () => copy() },
  { id: "cut", title: "Cut as Pluto text", keys: ["Ctrl+X"], why: needsBlock, run: () => copy().then(() => operations.removeSelected()) },
  { id: "paste", title: "Paste Pluto text", keys: ["Ctrl+V"], run: paste },
  { id: "all", title: "Select all blocks", keys: ["Ctrl+A"], run: () => choose(app.view.blocks.map(({ name }) => name)) },
  { id: "rename", title: "Rename", keys: ["F2"], why: needsBlock, run: () => focusProperties() },
  { id: "tidy", title: "Tidy: forget what was moved by hand", keys: ["Ctrl+Shift+L"], where: "page", why: () => (app.view.blocks.some((one) => one.moved) ? "" : "No block was moved by hand."), run: () => operations.tidy().then(fitAll) },
  { id: "fit", title: "Fit the graph into the window", keys: ["F"], run: fitAll },
  { id: "in", title: "Zoom in", keys: ["+", "="], run: () => zoom(1.25) },
  { id: "out", title: "Zoom out", keys: ["-"], run: () => zoom(1 / 1.25) },
  { id: "one", title: "Zoom to 100 %", keys: ["0"], run: () => zoomTo(1) },
  { id: "graph", title: "To the graph", keys: ["F6"], where: "page", run: () => go(only() ?? "start") },
  { id: "text", title: "To the text", keys: ["Shift+F6"], where: "page", run: () => focusText() },
  { id: "definition", title: "In the text: to the definition of a name", keys: ["F12"], where: "page", why: () => (hasText() ? "" : "The text is not there yet."), run: toDefinition },
  { id: "problem", title: "Next problem", keys: ["F8"], where: "page", why: () => (app.view.problems.length ? "" : "There are no problems."), run: () => nextProblem(1) },
  { id: "problem-back", title: "Previous problem", keys: ["Shift+F8"], where: "page", why: () => (app.view.problems.length ? "" : "There are no problems."), run: () => nextProblem(-1) },
  { id: "compile", title: "Compile", keys: ["Ctrl+Shift+B"], where: "page", why: broken, run: compile },
  { id: "run", title: "Run in simulation", keys: ["Ctrl+Enter"], where: "page", why: broken, run },
  { id: "theme", title: "Day or night", where: "page", run: theme },
  { id: "help", title: "Keys and gestures", keys: ["?", "F1"], where: "page", run: showHelp },
);

// Browsers keep pages from it where people have not allowed it.
const clipboard = (use) => use(navigator.clipboard).catch(() => {
  throw new Refused("The browser does not let this page use the clipboard: allow it for this address.");
});

async function copy() {
  await clipboard((board) => board.writeText(operations.asText()));
  say(`${chosenBlocks().length} copied as Pluto text.`);
}

async function paste() {
  const text = await clipboard((board) => board.readText());
  if (text.trim()) await operations.paste(text);
  else tell("There is no text to paste.");
}

const aside = seedField();
const shell = h("div", { class: "shell" },
  makeBar(), makeConflicts(),
  h("div", { class: "left" }, makePalette(), makeOutline()),
  h("main", { class: "graph-area" }, makeCanvas({ quick: quickAdd, properties: focusProperties })),
  makeBelow({ problems: makeProblems(), run: makeRun() }, aside),
  h("aside", { class: "side", "aria-label": "Properties and text" }, makeSplitter(), makeProperties(), makeText(makeHooksAside())));
document.body.append(shell, ...voices);

for (const bell of [begun, changed, selected, linked]) bell.heard(refreshButtons);
begun.heard(() => { if (!app.view.blocks.length) choose(["start"]); });
listenForKeys();
open();
