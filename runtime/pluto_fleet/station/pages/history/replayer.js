// A flight of the past, put into a world as it was at any instant: the keyframe before it, and all
// frames since. Parts of a recording are fetched when they are needed. Pure, but for the fetching.

import { batch } from "@preact/signals";
import { countUntil, eventsAt, tracksAt } from "./moments.js";

/** @typedef {(from: number) => Promise<Replay>} FetchPart */

/** A part that is here: what was shown from one instant up to another. @typedef {{ from: number, until: number, frames: Frame[] }} Part */

const GRID = 30; // seconds: where one scrubs to often, little is fetched twice
const SOON = 5; // seconds before the end of a part in which the next one is fetched

/** The newest row of each name in some frames. @template {Record<string, any>} Row @param {readonly Frame[]} frames @param {(frame: Frame) => Row[]} of @param {keyof Row & string} by */
function newest(frames, of, by) {
  /** @type {Map<string, Row>} */
  const rows = new Map();
  for (const frame of frames) {
    for (const row of of(frame) ?? []) rows.set(row[by], row);
  }
  return [...rows.values()];
}

export class Replayer {
  /** @param {World} world that shows it @param {FetchPart} fetchPart */
  constructor(world, fetchPart) {
    this.world = world;
    this.fetchPart = fetchPart;
    /** @type {Replay | null} the first part, with what is of the whole flight */
    this.whole = null;
    /** @type {Part[]} */
    this.parts = [];
    /** @type {Part | null} that which the world shows, up to the frame at `at` */
    this.part = null;
    this.at = -1;
    this.asked = 0;
    /** @type {Map<number, Promise<unknown>>} by where they begin */
    this.fetching = new Map();
  }

  /** Fetch the first part, and show its first instant. */
  async open() {
    this.whole = await this.fetchPart(0);
    this.keep(0, this.whole);
    this.show(0);
    return this.whole;
  }

  get seconds() {
    return this.whole?.seconds ?? 0;
  }

  /** @param {number} from @param {Replay} replay */
  keep(from, { frames, next }) {
    if (!frames.length) return;
    this.parts.push({ from, until: next ?? Infinity, frames });
  }

  /** The part in which an instant lies, if it is here. @param {number} t */
  having(t) {
    return this.parts.find(({ from, until }) => from <= t && t < until);
  }

  /** Show an instant; where its part is not here yet, false: then ask `seek`. @param {number} t seconds */
  show(t) {
    const part = this.having(t);
    if (!part) return !this.parts.length && this.whole !== null; // a recording of nothing
    const last = Math.max(0, countUntil(part.frames, t, (frame) => frame.t) - 1);
    const goesOn = part === this.part && last >= this.at;
    const frames = part.frames.slice(goesOn ? this.at + 1 : 0, last + 1);
    [this.part, this.at] = [part, last];
    batch(() => {
      const { missions, drones, alerts, tracks, events } = this.world;
      const rows = [
        newest(frames, (frame) => frame.missions, "name"), newest(frames, (frame) => frame.drones, "id"),
        newest(frames, (frame) => frame.alerts, "id"),
      ];
      [missions, drones, alerts].forEach((shown, kind) => {
        const fresh = /** @type {any[]} */ (rows[kind]);
        if (goesOn) shown.take(fresh);
        else shown.replace(fresh);
      });
      tracks.replace(tracksAt(this.whole?.tracks ?? [], t));
      events.replace(eventsAt(this.whole?.events ?? [], t));
      this.world.log.replace(this.until(this.whole?.log ?? [], t));
      this.world.results.replace(this.until(this.whole?.results ?? [], t));
      this.world.state.value = { ...part.frames[last].state, time: Math.max(t, part.frames[last].t), known: true };
    });
    return true;
  }

  /** Entries that there were at an instant. @template {LogLine | Result} Entry @param {readonly Entry[]} entries @param {number} t */
  until(entries, t) {
    return entries.slice(0, countUntil(entries, t, ({ time }) => time));
  }

  /** Show an instant, as soon as its part is here; false: another one was asked for meanwhile. @param {number} t seconds */
  async seek(t) {
    this.asked += 1;
    const { asked } = this;
    let from = Math.floor(t / GRID) * GRID;
    while (!this.show(t)) {
      from = Math.max(from, this.reached(from));
      await this.fetch(from);
      if (!this.having(from)) throw new Error(`the part from ${from} s on does not hold that instant`);
      if (asked !== this.asked) return false;
    }
    return true;
  }

  /** Where what is here from an instant on ends. @param {number} from */
  reached(from) {
    let until = from;
    for (let part = this.having(until); part && part.until < Infinity; part = this.having(until)) until = part.until;
    return until;
  }

  /** Fetch what comes soon after an instant, if it is not here. @param {number} t @param {number} speed */
  ahead(t, speed) {
    const soon = Math.min(t + SOON * Math.max(1, speed), this.seconds);
    const from = this.reached(Math.floor(t));
    if (!this.having(soon) && from <= soon) this.fetch(from).catch(() => null); // asked again when it is needed
  }

  /** @param {number} from */
  fetch(from) {
    let under = this.fetching.get(from);
    if (!under) {
      under = this.fetchPart(from).then((replay) => this.keep(from, replay)).finally(() => this.fetching.delete(from));
      this.fetching.set(from, under);
    }
    return under;
  }
}
