// What is wrong, with the blocks it is about; where there is a way that fails, it is walked.

import { refused, say } from "../announce.js";
import { light } from "../canvas/blocks.js";
import { fit, reveal } from "../canvas/camera.js";
import { lightEdges } from "../canvas/wires.js";
import { button, h, icon, put, still } from "../dom.js";
import { ask } from "../link.js";
import { app, begun, changed, choose, keyOf, outOf } from "../state.js";
import { markdown, words } from "../text/markdown.js";
import { showPlace } from "../text/pane.js";
import { showDialog } from "../dialogs/dialog.js";

const STEP = 700; // milliseconds at each block of a walk

export function showProblem(problem, focus = false) {
  const nodes = problem.blocks.map((name) => app.nodes.get(name)).filter(Boolean);
  choose(nodes.map(({ name }) => name));
  if (nodes.length === 1) reveal(nodes[0]);
  else if (nodes.length) fit(nodes);
  showPlace(problem.file, problem.from, problem.to, focus);
}

export function problemRow(problem, index) {
  const { severity, message, help, line, file, path, fix, code } = problem;
  return h("li", { class: `problem ${severity}` },
    icon(severity === "error" ? "bad" : "warning", 16),
    h("div", { class: "problem-text" },
      h("button", { type: "button", class: "problem-title", onclick: () => showProblem(problem) },
        h("span", { class: "unseen" }, `${severity}: `), words(message)),
      help && h("p", { class: "hint" }, words(help)),
      h("p", { class: "problem-tools" },
        h("span", { class: "hint" }, `${file === "hooks" ? "hooks.py" : app.file}, line ${line}`),
        fix && button("Mend it", () => ask("fix", { problem: index, version: app.version }).then(() => say("Mended."), refused), { kind: "small", sign: "fix" }),
        path.length > 0 && button("Walk its path", () => walk(path), { kind: "small", sign: "path" }),
        h("button", { type: "button", class: "link small", onclick: () => explain(code) }, code))));
}

let walking = 0;

// The shortest way that fails, block by block.
export async function walk(path) {
  const own = (walking += 1);
  const nodes = path.map(([name]) => app.nodes.get(name)).filter(Boolean);
  choose([]);
  fit(nodes);
  const names = new Set();
  const keys = new Set();
  for (let i = 0; i < path.length; i += 1) {
    const [name, passes] = path[i];
    if (own !== walking) return;
    names.add(name);
    const next = path[i + 1]?.[0];
    const edge = outOf(name).find((one) => one.target === next);
    if (edge) keys.add(keyOf(edge));
    light(names);
    lightEdges(keys);
    say(`${name}${passes ? `, ${passes}` : ""}${i === path.length - 1 ? ". That is where it fails." : ""}`);
    if (!still()) await new Promise((done) => setTimeout(done, STEP));
  }
  if (own === walking) choose([path.at(-1)[0]].filter((name) => app.nodes.has(name)));
}

function stopWalking() {
  walking += 1;
  light(new Set());
  lightEdges(new Set());
}

export async function explain(code) {
  try {
    const { markdown: text } = await ask("explain", { code });
    showDialog({ title: code, content: markdown(text, { skipTitle: false }), kind: "wide" });
  } catch (error) {
    refused(error);
  }
}

export function makeProblems() {
  const list = h("ul", { class: "problem-list scroll", tabIndex: 0, "aria-label": "Problems" });
  const none = h("p", { class: "none" }, icon("good"), h("span", {}));
  function draw() {
    stopWalking();
    const found = app.view.problems;
    list.replaceChildren(...found.map(problemRow));
    list.hidden = !found.length;
    none.hidden = found.length > 0;
    put(none.lastChild, app.view.blocks.length ? "No problems: no mission can get stuck in this graph." : "No problems.");
  }
  begun.heard(draw);
  changed.heard(draw);
  return h("div", { class: "problems" }, list, none);
}

