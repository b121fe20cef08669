// What did not go as planned in a flight, as marks on its time. Pure.

/** @typedef {{ time: number, text: string }} Mark */

const SAME = 1; // seconds within which two marks are one
const BESIDE = 0.05; // of the whole: marks that are nearer could not be hit one by one on a phone

/** What the console called trouble, one mark for each moment. @param {Pick<Replay, "log" | "seconds">} replay @returns {Mark[]} */
export function marksOf({ log, seconds }) {
  const near = Math.max(SAME, seconds * BESIDE);
  /** @type {Mark[]} */
  const marks = [];
  for (const { kind, time, mission, text } of log) {
    if (kind !== "bad") continue;
    const said = mission === null ? text : `${mission}: ${text}`;
    const last = marks.at(-1);
    if (last && time - last.time < near) last.text += `\n${said}`;
    else marks.push({ time, text: said });
  }
  return marks;
}

/** The next mark, or the one before, from an instant on. @param {readonly Mark[]} marks @param {number} time @param {1 | -1} way */
export const nextMark = (marks, time, way) => (way === 1
  ? marks.find((mark) => mark.time > time + 0.01)
  : marks.findLast((mark) => mark.time < time - 0.01));
