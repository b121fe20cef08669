// The properties of one edge: which statuses it takes, and which really come along it.

import { go } from "../canvas/keys.js";
import { choose } from "../dialogs/chooser.js";
import { button, fill, h, icon, status } from "../dom.js";
import { disconnect, redirect, setGuard } from "../operations.js";
import { END, START, app, isSource, keyOf, selection } from "../state.js";
import { targetOptions } from "../dialogs/connect.js";
import { problemRow } from "./problems.js";

export function edgePanel() {
  const element = h("div", { class: "panel" });
  let shown = "";

  function update() {
    const edge = app.edges.get(selection.edge);
    if (!edge) return;
    const now = JSON.stringify([edge, app.nodes.get(edge.source)?.emits]);
    if (now === shown) return;
    shown = now;
    const focused = element.contains(document.activeElement) ? document.activeElement.dataset.part : null;
    fill(element, content(edge));
    if (focused) element.querySelector(`[data-part="${focused}"]`)?.focus();
  }

  update();
  return { element, update, focus: () => element.querySelector("input, .way")?.focus() };
}

function content(edge) {
  const source = app.nodes.get(edge.source);
  const target = app.nodes.get(edge.target);
  const accepts = edge.target === END ? ["COMPLETED", "FAILED"] : target.accepts_by_guard ?? target.accepts;
  const choices = isSource(edge.source) ? [] : source.emits;
  const guarded = edge.when.length > 0;
  const how = guarded ? "when" : edge.otherwise ? "otherwise" : "all";
  const pick = (value, words, doc) => h("label", { class: "option" },
    h("input", { type: "radio", name: "guard", value, checked: how === value, "data-part": value, onchange: () => guard(value) }),
    h("span", {}, h("strong", {}, words), h("span", { class: "hint" }, doc)));
  const guard = (value) => {
    if (value === "all") setGuard(edge, [], false);
    else if (value === "otherwise") setGuard(edge, [], true);
    else setGuard(edge, edge.statuses.length ? edge.statuses : choices.filter((one) => accepts.includes(one)).slice(0, 1), false);
  };
  const toggle = (one) => {
    const when = choices.filter((other) => (other === one) !== edge.when.includes(other));
    if (when.length) setGuard(edge, when, false);
  };
  const end = (name) => h("button", { type: "button", class: "link", onclick: () => go(name) }, name);
  return [
    h("div", { class: "panel-top" }, h("h3", { class: "edge-title" }, end(edge.source), icon("wire", 16), end(edge.target)),
      !edge.implicit && edge.source !== START && button("Lead elsewhere", () => lead(edge), { kind: "small", sign: "path" }),
      !edge.implicit && h("button", {
        type: "button", class: "button quiet sign small danger", title: "Remove (Delete)", "aria-label": "Remove this edge", onclick: () => disconnect(edge),
      }, icon("trash", 16))),
    h("div", { class: "passes" }, h("span", { class: "hint" }, "passes"),
      edge.statuses.length ? edge.statuses.map((one) => [status(one), " "])
        : h("span", { class: "hint" }, edge.known ? "nothing yet: no mission comes along here" : "not known")),
    edge.fork && h("p", { class: "hint" }, "One of several ways for the same status: a clone of the mission goes along each."),
    edge.implicit ? h("p", { class: "hint" }, "Not written: no edge takes these statuses, so missions end. Draw an edge to end to say so.")
      : isSource(edge.source) ? h("p", { class: "hint" }, edge.source === START ? "Every mission of a user begins along this edge." : "The missions of this event begin along this edge.")
        : h("fieldset", { class: "guard" }, h("legend", {}, "Takes"),
          pick("all", "all that fits", edge.target === END ? "" : `what ${edge.target} accepts`),
          pick("otherwise", "otherwise", "what no other edge takes"),
          pick("when", "only when", ""),
          how === "when" && h("div", { class: "statuses" }, choices.map((one) => h("label", {
            class: "check", title: accepts.includes(one) ? "" : `${edge.target} does not accept ${one}`,
          }, h("input", { type: "checkbox", checked: edge.when.includes(one), "data-part": one, onchange: () => toggle(one) }), status(one))))),
    ...(edge.problems ?? []).map((i) => h("ul", { class: "problem-list" }, problemRow(app.view.problems[i], i))),
  ];
}

async function lead(edge) {
  const target = await choose({
    title: `Lead the edge from ${edge.source} to`, options: targetOptions(edge.source, edge.when),
  });
  if (target && keyOf({ ...edge, target }) !== keyOf(edge)) redirect(edge, { target });
}
