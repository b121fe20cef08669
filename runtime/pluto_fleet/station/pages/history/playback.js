// The clock of a replay: it runs, stands, and is set. Pure.

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
