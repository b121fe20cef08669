// A sign beside each word of a status, so that colour alone never says anything.
import { svg } from "./dom.js";

const PATHS = {
  play: "M5 3.2v9.6L13 8z",
  tick: "M3.2 8.4l3.2 3.2 6.4-7",
  cross: "M4 4l8 8M12 4l-8 8",
  bars: "M5.6 3.5v9M10.4 3.5v9",
  ring: "M8 3a5 5 0 1 0 .01 0z",
  clock: "M8 2.6a5.4 5.4 0 1 0 .01 0zM8 5v3.2l2.2 1.6",
  ask: "M5.6 5.8a2.4 2.4 0 1 1 3.4 2.2c-.8.4-1 .8-1 1.6M8 12v.4",
  none: "M3.4 8a4.6 4.6 0 1 0 9.2 0 4.6 4.6 0 1 0-9.2 0M4.8 4.8l6.4 6.4",
  home: "M3 8l5-4.6L13 8M4.6 7v5.4h6.8V7",
  bolt: "M9 2.4L4.4 9H8l-1 4.6L11.6 7H8z",
  next: "M4 3.6l5 4.4-5 4.4M11.6 3.6v8.8",
};
const FILLED = new Set(["play", "bolt"]);

const OF = {
  UNEXECUTED: ["ring", "calm"],
  RUNNING: ["play", "busy"],
  STANDBY: ["clock", "calm"],
  COMPLETED: ["tick", "good"],
  FAILED: ["cross", "bad"],
  PAUSED: ["bars", "warn"],
  CANCELLED: ["none", "calm"],
  UNCERTAIN: ["ask", "warn"],
  HELD: ["ask", "warn"],
  WAITING: ["ring", "calm"],
  EXECUTING: ["play", "busy"],
  SKIPPED: ["next", "calm"],
  FREE: ["tick", "good"],
  BUSY: ["play", "busy"],
  RETURNING: ["home", "busy"],
  CHARGING: ["bolt", "calm"],
  RECOVERING: ["clock", "warn"],
  LOST: ["ask", "bad"],
  OFFLINE: ["cross", "bad"],
  RETIRED: ["none", "calm"],
};

// The tone of a status: calm, busy, good, warn or bad.
export const tone = (status) => OF[status]?.[1] ?? "calm";

// An empty sign; show(status) draws the status's path into it.
export function sign() {
  const path = svg("path", { d: PATHS.ring });
  const element = svg("svg", { class: "m-sign", viewBox: "0 0 16 16", "aria-hidden": "true" }, path);
  let shown = null;
  const show = (status) => {
    if (status === shown) return;
    shown = status;
    const name = OF[status]?.[0] ?? "ring";
    path.setAttribute("d", PATHS[name]);
    element.setAttribute("class", FILLED.has(name) ? "m-sign filled" : "m-sign");
  };
  return { element, show };
}
