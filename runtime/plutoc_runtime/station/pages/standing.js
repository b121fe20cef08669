// How missions, trips and drones stand: a word with a sign, so that colour alone never says it.

import { fill, h, icon, put, set, shown } from "./dom.js";

const STANDS = {
  UNEXECUTED: ["Not started", "wait", "calm"],
  RUNNING: ["Flying", "start", "busy"],
  STANDBY: ["Waiting", "wait", "calm"],
  COMPLETED: ["Completed", "good", "good"],
  FAILED: ["Failed", "bad", "bad"],
  PAUSED: ["Paused", "pause", "warn"],
  CANCELLED: ["Cancelled", "close", "calm"],
  UNCERTAIN: ["Needs you", "warning", "warn"],
  HELD: ["Needs you", "warning", "warn"],
  WAITING: ["To do", "wait", "calm"],
  EXECUTING: ["Flying", "start", "busy"],
  SKIPPED: ["Skipped", "close", "calm"],
  FREE: ["Ready", "good", "good"],
  BUSY: ["Flying", "start", "busy"],
  RETURNING: ["Coming home", "home", "busy"],
  CHARGING: ["Charging", "wait", "calm"],
  RECOVERING: ["Recovering", "wait", "warn"],
  LOST: ["Lost", "warning", "bad"],
  OFFLINE: ["Not connected", "info", "calm"],
  RETIRED: ["Retired", "close", "calm"],
};

export const ended = ({ status }) => ["COMPLETED", "FAILED", "CANCELLED"].includes(status);
export const needsYou = ({ status }) => status === "UNCERTAIN" || status === "HELD";
export const round = (number) => Math.round(number * 100) / 100;

// An element whose `show(status)` writes another one.
export function standing() {
  const element = h("span", { class: "standing" });
  element.show = (status) => {
    if (element.dataset.status === status) return;
    element.dataset.status = status;
    const [word, sign, tone] = STANDS[status] ?? [status, "info", "calm"];
    set(element, "data-tone", tone);
    fill(element, icon(sign), word);
  };
  return element;
}

export const level = (charge) => (charge < 0.2 ? "low" : charge < 0.4 ? "middle" : "full");

// A small bar with its percentage; `show(null)` where nothing is known.
export function battery() {
  const bar = h("i");
  const text = h("span");
  const element = h("span", { class: "battery", hidden: true },
    h("span", { class: "bar", "aria-hidden": "true" }, bar), text);
  let before = null;
  element.show = (charge) => {
    const whole = charge === null || charge === undefined ? null : Math.round(charge * 100);
    if (whole === before) return;
    before = whole;
    shown(element, whole !== null);
    bar.style.width = `${whole}%`;
    set(element, "data-level", level(whole / 100));
    put(text, `${whole} %`);
  };
  return element;
}

// A row or a line that shows the chosen mission.
export const mark = (element, yes) => set(element, "data-chosen", yes && "yes");
