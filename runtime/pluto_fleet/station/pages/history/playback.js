// What a replay is made of: its clock, which runs, stands, and is set; marks on its time where something did not
// go as planned; and the levels of batteries as lines of a chart. Pure.

import { signal } from "@preact/signals";

export const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 30, 60];
const STEP = 5; // seconds of an arrow key
const LEAP = 30; // and with Shift

export class Playback {
  /** @param {number} [seconds] the length of the flight */
  constructor(seconds = 0) {
    this.seconds = signal(seconds);
    this.time = signal(0);
    this.isPlaying = signal(false);
    this.speed = signal(1);
  }

  /** @param {number} t */
  set(t) {
    this.time.value = Math.min(Math.max(t, 0), this.seconds.peek());
  }

  /** Let the clock run on for some seconds of real time; at the end it stands. @param {number} real */
  tick(real) {
    if (!this.isPlaying.peek()) return;
    this.set(this.time.peek() + real * this.speed.peek());
    if (this.time.peek() >= this.seconds.peek()) this.isPlaying.value = false;
  }

  /** Run, or stand; from its end it runs once more. */
  toggle() {
    const isAtEnd = this.time.peek() >= this.seconds.peek();
    if (!this.isPlaying.peek() && isAtEnd) this.set(0);
    this.isPlaying.value = !this.isPlaying.peek() && this.seconds.peek() > 0;
  }

  /** Do what a key says; false: nothing. @param {{ key: string, shiftKey: boolean }} pressed */
  press({ key, shiftKey }) {
    const step = shiftKey ? LEAP : STEP;
    const act = /** @type {Record<string, () => void>} */ ({
      " ": () => this.toggle(),
      ArrowLeft: () => this.set(this.time.peek() - step), ArrowRight: () => this.set(this.time.peek() + step),
      Home: () => this.set(0), End: () => this.set(this.seconds.peek()),
    })[key];
    act?.();
    return act !== undefined;
  }
}

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

const MOST = 300; // points of a line: more cannot be seen

/** @typedef {{ drone: string, points: string, lowest: number }} Line points as SVG has them: time over its length, level from the top */

/** The lowest of every few pairs, so that a dip is never left out. @param {readonly (readonly number[])[]} pairs */
function thinned(pairs) {
  const every = Math.ceil(pairs.length / MOST);
  if (every <= 1) return pairs;
  /** @type {(readonly number[])[]} */
  const kept = [];
  for (let at = 0; at < pairs.length; at += every) {
    kept.push(pairs.slice(at, at + every).reduce((low, pair) => (pair[1] < low[1] ? pair : low)));
  }
  return kept;
}

/** @param {Record<string, readonly (readonly number[])[]>} batteries of each drone pairs of time and level @param {number} seconds @returns {Line[]} */
export function linesOf(batteries, seconds) {
  return Object.entries(batteries).filter(([, pairs]) => pairs.length).map(([drone, pairs]) => ({
    drone,
    lowest: Math.min(...pairs.map(([, level]) => level)),
    points: thinned(pairs).map(([time, level]) =>
      `${((time / (seconds || 1)) * 1000).toFixed(1)},${((1 - level) * 100).toFixed(1)}`).join(" "),
  })).toSorted((a, b) => a.drone.localeCompare(b.drone, undefined, { numeric: true }));
}
