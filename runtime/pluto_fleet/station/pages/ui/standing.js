// How a mission, a trip or a drone stands: a word with a sign, so that colour alone never says it.

import { h } from "preact";
import { tOr } from "../core/i18n.js";
import { Icon } from "./icon.js";

/** @import { IconName } from "./icon.js" */

/** @type {Record<string, [IconName, "calm" | "busy" | "good" | "warn" | "bad"]>} */
const SIGNS = {
  UNEXECUTED: ["wait", "calm"], RUNNING: ["start", "busy"], STANDBY: ["wait", "calm"],
  COMPLETED: ["good", "good"], FAILED: ["bad", "bad"], PAUSED: ["pause", "warn"],
  CANCELLED: ["close", "calm"], UNCERTAIN: ["warning", "warn"], HELD: ["warning", "warn"],
  WAITING: ["wait", "calm"], EXECUTING: ["start", "busy"], SKIPPED: ["close", "calm"],
  FREE: ["good", "good"], LOW: ["wait", "calm"], BUSY: ["start", "busy"], RETURNING: ["home", "busy"],
  CHARGING: ["wait", "calm"], RECOVERING: ["wait", "warn"], LOST: ["warning", "bad"],
  OFFLINE: ["info", "calm"], LANDED: ["info", "calm"], ALOFT: ["warning", "warn"],
  UNKNOWN: ["warning", "warn"], RETIRED: ["close", "calm"],
};

/** @param {string} status */
export const toneOf = (status) => (SIGNS[status] ?? ["info", "calm"])[1];

/** @param {{ status: string }} props */
export function Standing({ status }) {
  const [name, tone] = SIGNS[status] ?? ["info", "calm"];
  return h("span", { class: `standing-word ${tone}`, "data-status": status },
    h(Icon, { name, size: 16 }), tOr(`status.${status}`, status));
}
