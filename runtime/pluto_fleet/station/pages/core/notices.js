// What the page tells its user in passing: at most one good and one bad message, and what is only read out.

import { signal } from "@preact/signals";

const SHOWN_FOR = 6000; // ms
const UNDO_FOR = 20000; // ms

/** @type {Signal<Notice | null>} stays until it is put away */
export const badNotice = signal(null);
/** @type {Signal<Notice | null>} */
export const goodNotice = signal(null);
/** Only read out, by screen readers. */
export const spoken = signal("");

let timer = 0;

/**
 * Tell the user something.
 * @param {string} text
 * @param {{ bad?: boolean, isSaid?: boolean, undo?: (() => void) | null, settles?: boolean }} [how] settles: the bad one is over
 */
export function tell(text, { bad = false, isSaid = false, undo = null, settles = false } = {}) {
  if (settles) badNotice.value = null;
  (bad ? badNotice : goodNotice).value = { text, bad, isSaid, undo };
  if (bad) return;
  clearTimeout(timer);
  timer = setTimeout(() => { goodNotice.value = null; }, undo ? UNDO_FOR : SHOWN_FOR);
}

/** Read something out, and show nothing. @param {string} text */
export const speakOut = (text) => { spoken.value = text; };
