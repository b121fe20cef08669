// What the station answers, at the lower edge of every page, and read out by screen readers.
//
//   say("Mission 2 is deleted.", { undo: () => … });    // with a way back
//   say("…", { bad: true });                            // stays until it is put away
//   hush("…")                                           // only read out, not shown

import { fill, h, put } from "./dom.js";
import { icon } from "./icons.js";

const TIME = 6000;
const UNDO_TIME = 20000;

const politely = h("div", { class: "notices", role: "status" });
const loudly = h("div", { class: "notices", role: "alert" });
const silently = h("div", { class: "unseen", role: "status" });

export const notices = h("div", { class: "notice-corner" }, loudly, politely, silently);

const timers = new Map();

function away(place) {
  clearTimeout(timers.get(place));
  fill(place);
}

export function say(text, { undo = null, bad = false } = {}) {
  const place = bad ? loudly : politely;
  away(place);
  const close = h("button", {
    class: "button quiet icon", "aria-label": "Put this message away", onclick: () => away(place),
  }, icon("close"));
  const back = undo && h("button", {
    class: "button small", onclick: () => { away(place); undo(); },
  }, icon("undo"), "Undo");
  fill(place, h("div", { class: bad ? "notice bad" : "notice" },
    icon(bad ? "bad" : "info"), h("p", {}, text), back, close));
  if (!bad) timers.set(place, setTimeout(away, undo ? UNDO_TIME : TIME, place));
}

// Puts a bad message away that is true no more.
export function unsay() {
  away(loudly);
}

export function hush(text) {
  put(silently, text);
}
