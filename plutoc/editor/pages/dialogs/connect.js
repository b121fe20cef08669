// Connect by keyboard: which statuses, and to which block. What cannot be says why.

import { say } from "../announce.js";
import { targetsOf } from "../canvas/wiring.js";
import { h, status } from "../dom.js";
import { connect, connectAll } from "../operations.js";
import { END, app, free, isSource } from "../state.js";
import { choose } from "./chooser.js";

export async function targetOptions(source, when) {
  const targets = await targetsOf(source, when);
  return Object.entries(targets).map(([name, why]) => {
    const node = app.nodes.get(name);
    return { id: name, label: name, detail: node?.terminal ? node.doc : node?.kind ?? "", why };
  });
}

export async function connectFrom(source, at) {
  const node = app.nodes.get(source);
  const open = free(source);
  let when = [];
  const target = await choose({
    title: `Connect ${source} to`, at, options: targetOptions(source, when), placeholder: "Type a block’s name",
    above: (renew) => !isSource(source) && node.emits.length > 1 && statuses(renew),
  });
  if (!target) return;
  const made = when.length ? await connect(source, target, when) : await connectAll(source, target);
  if (made) say(`${source} is connected to ${target === END ? "the end" : target}.`);

  function statuses(renew) {
    return h("fieldset", { class: "statuses" }, h("legend", { class: "hint" }, open.length ? "Only when (none: all that is free)" : "Only when"),
      node.emits.map((one) => h("label", { class: "check" }, h("input", {
        type: "checkbox", onchange: async ({ target: box }) => {
          when = node.emits.filter((other) => (other === one ? box.checked : when.includes(other)));
          renew(await targetOptions(source, when));
        },
      }), status(one))));
  }
}
