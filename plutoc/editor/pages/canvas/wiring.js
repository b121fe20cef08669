// Drawing an edge by hand: only blocks that can take it light up, and the others say why not.

import { say, tell } from "../announce.js";
import { h, put, shown, svg } from "../dom.js";
import { ask } from "../link.js";
import { connect, connectAll } from "../operations.js";
import { START, app, free } from "../state.js";
import { showTargets } from "./blocks.js";
import { toWorld, viewport, world } from "./camera.js";
import { follow } from "./follow.js";
import { loose, portAt } from "./routes.js";

const line = svg("path", { class: "loose" });
const over = svg("svg", { class: "wires over", "aria-hidden": "true" }, line);
const why = h("p", { class: "why-not", hidden: true });

export function prepare() {
  world.append(over);
  viewport.append(why);
}

// name → null, or why not; asked of the server, which knows the language.
export async function targetsOf(source, when) {
  const { targets } = await ask("ports", { source, when });
  return targets;
}

export function drawWire(event, source, port, quick) {
  const node = app.nodes.get(source);
  const when = port === "all" ? [] : [port];
  const from = portAt(node, port);
  let targets = null;
  let over_ = null;
  line.classList.remove("ends");
  targetsOf(source, when).then((found) => {
    targets = found;
    if (line.classList.contains("drawn")) showTargets(targets);
  }, () => {});
  line.dataset.status = port === "all" ? "many" : port;
  follow(event, (now) => {
    line.classList.add("drawn");
    if (targets) showTargets(targets);
    line.setAttribute("d", loose(from, toWorld(now.clientX, now.clientY)));
    over_ = document.elementFromPoint(now.clientX, now.clientY)?.closest(".block")?.dataset.block ?? null;
    const reason = over_ && targets?.[over_];
    line.classList.toggle("refused", Boolean(reason));
    explain(reason, now);
  }, async (end, moved) => {
    line.classList.remove("drawn", "refused");
    line.removeAttribute("d");
    showTargets(null);
    explain(null);
    if (!moved) {
      if (end.type === "pointerup") say("Drag from here to a block, or press C to choose one from a list.");
      return;
    }
    if (!over_) {
      const at = toWorld(end.clientX, end.clientY);
      const statuses = when.length ? when : source === START ? ["UNEXECUTED"] : free(source);
      quick({ at, clientX: end.clientX, clientY: end.clientY, from: source, when, statuses });
      return;
    }
    targets ??= await targetsOf(source, when).catch(() => ({}));
    if (targets[over_]) tell(targets[over_], { kind: "bad", stays: true });
    else if (when.length) connect(source, over_, when);
    else connectAll(source, over_);
  }, { rim: true });
}

function explain(reason, now) {
  shown(why, reason);
  if (!reason) return;
  put(why, reason);
  const { left, top } = viewport.getBoundingClientRect();
  why.style.transform = `translate(${now.clientX - left + 16}px, ${now.clientY - top + 16}px)`;
}

