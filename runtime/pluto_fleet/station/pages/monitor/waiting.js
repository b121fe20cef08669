// In words: why a mission waits, what it is at, and when it is due. Pure, but for the texts.

import { capital, duration, number, plain, roughly } from "../core/format.js";
import { t } from "../core/i18n.js";
import { isTranslated, say } from "../core/said.js";

/** A trip's name, or its action if it was given none. @param {TripRow} trip @param {number} index */
export const calledTrip = (trip, index) =>
  (trip.name === String(index + 1) ? capital(trip.action) : trip.name);

/** "2 of 5: kitchen". @param {MissionRow} row */
export function progress({ trips, current, done, total }) {
  const trip = current === null ? undefined : trips[current];
  return trip ? t("monitor.trip-of", { n: (current ?? 0) + 1, total, trip: calledTrip(trip, current ?? 0) })
    : t("monitor.done-of", { done, total });
}

/** Why it stands as it does, and whether in the reader's language. @param {MissionRow} row @param {number} now */
export function why({ status, reason, question, wait, until }, now) {
  const words = question?.said ?? (reason || status === "PAUSED" ? null : wait);
  const text = words ? say(words) : reason;
  return {
    text: until !== null && until > now ? `${text} (${duration(until - now)})` : text,
    isOwn: words !== null && isTranslated(words),
  };
}

/** @param {MissionRow} row @param {number} now */
export const due = ({ late, due: at }, now) => {
  if (late) return t("monitor.late");
  return at === null ? "" : t("monitor.due-in", { time: roughly(Math.max(0, at - now)) });
};

/** "take photo at 1.5; 2". @param {TripRow} trip */
export const done = ({ action, x, y }) =>
  t("monitor.action-at", { action: plain(action), x: number(x), y: number(y) });

/** How many missions stand how: { RUNNING: 3, … }. @param {MissionRow[]} rows */
export function counted(rows) {
  /** @type {Record<string, number>} */
  const counts = {};
  for (const { status } of rows) counts[status] = (counts[status] ?? 0) + 1;
  return counts;
}
