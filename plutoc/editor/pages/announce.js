// What is said to people: read aloud where they cannot see it, and shown where it must not be missed.

import { button, h, icon, signButton } from "./dom.js";
import { Refused } from "./link.js";

const STAYS = 7000;

const polite = h("div", { class: "unseen", role: "status", "aria-live": "polite" });
const notices = h("div", { class: "notices", role: "region", "aria-label": "Notices" });

export const voices = [polite, notices];

// Read aloud only: what those who see the picture see.
export function say(text) {
  polite.textContent = "";
  requestAnimationFrame(() => { polite.textContent = text; });
}

// A sentence that stays for a while, or until it is closed.
export function tell(text, { kind = "info", stays = kind !== "bad", action = null } = {}) {
  const known = [...notices.children].find((one) => one.dataset.text === text);
  known?.remove();
  const close = () => notice.remove();
  const notice = h("div", { class: `notice ${kind}`, "data-text": text },
    icon(kind === "bad" ? "bad" : kind === "good" ? "good" : "info"),
    h("p", { role: kind === "bad" ? "alert" : "status" }, text),
    action && button(action[0], () => { close(); action[1](); }, { kind: "small" }),
    signButton("Close this notice", close, "close"));
  notices.append(notice);
  if (stays) setTimeout(close, STAYS);
  return close;
}

// What was refused is a sentence of the server; all else is a fault of this page and stays one.
export function refused(error) {
  if (!(error instanceof Refused)) throw error;
  tell(error.message, { kind: "bad", stays: true });
}
