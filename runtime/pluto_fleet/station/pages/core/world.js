// What is known of a flight: each row a signal of its own, so that a page draws what has changed and
// nothing else. The same for a live flight, a replay and a rehearsal.

import { batch, signal } from "@preact/signals";

export const LINES_KEPT = 5000; // of the console, and results
const EVENTS_KEPT = 500;

/** Rows by their key. @template {Record<string, any>} Row */
class Rows {
  /** @param {keyof Row & string} key */
  constructor(key) {
    this.key = key;
    /** @type {Map<string, Signal<Row>>} */
    this.rows = new Map();
    /** The keys, in the order in which they came. */
    this.keys = signal(/** @type {string[]} */ ([]));
    /** Counts the changes, for those who read all rows. */
    this.version = signal(0);
  }

  /** @param {Row[]} fresh */
  take(fresh) {
    if (!fresh.length) return;
    let [isNew, isOther] = [false, false];
    for (const row of fresh) {
      const known = this.rows.get(row[this.key]);
      isOther ||= known?.peek() !== row;
      if (known) known.value = row;
      else {
        this.rows.set(row[this.key], signal(row));
        isNew = true;
      }
    }
    if (isNew) this.keys.value = [...this.rows.keys()];
    if (isOther) this.version.value += 1;
  }

  /** Have exactly these rows; those that stay keep their signals. @param {Row[]} rows */
  replace(rows) {
    /** @type {Set<string>} */
    const keys = new Set(rows.map((row) => row[this.key]));
    const gone = [...this.rows.keys()].filter((key) => !keys.has(key));
    for (const key of gone) this.rows.delete(key);
    this.take(rows);
    if (!gone.length) return;
    this.keys.value = [...this.rows.keys()];
    this.version.value += 1;
  }

  /** A row; subscribes to it, also before it is there and after all were cleared. @param {string | null | undefined} key @returns {Row | undefined} */
  get(key) {
    void this.keys.value;
    return key === null || key === undefined ? undefined : this.rows.get(key)?.value;
  }

  /** All rows; subscribes to every change. @returns {Row[]} */
  all() {
    void this.version.value;
    return [...this.rows.values()].map((row) => row.peek());
  }

  clear() {
    this.rows.clear();
    this.keys.value = [];
    this.version.value += 1;
  }
}

/** The newest entries of a list that only grows, by their numbers. @template {{ number: number }} Entry */
class Tail {
  constructor() {
    /** @type {Signal<Entry[]>} */
    this.entries = signal([]);
  }

  get last() {
    return this.entries.peek().at(-1)?.number ?? 0;
  }

  /** @param {Entry[]} fresh */
  take(fresh) {
    const { last } = this;
    const newer = fresh.filter(({ number }) => number > last);
    if (newer.length) this.entries.value = [...this.entries.peek(), ...newer].slice(-LINES_KEPT);
  }

  /** Whether none is missing of those that are kept: a message has only the newest. */
  get isWhole() {
    return this.entries.value.length >= Math.min(this.last, LINES_KEPT);
  }

  /** Have what is known of entries by now, of those that are here. @param {Entry[]} amended */
  amend(amended) {
    if (!amended.length) return;
    const byNumber = new Map(amended.map((entry) => [entry.number, entry]));
    this.entries.value = this.entries.peek().map((entry) => byNumber.get(entry.number) ?? entry);
  }

  /** Take entries that may be older than the newest. @param {Entry[]} entries */
  fill(entries) {
    const byNumber = new Map([...entries, ...this.entries.peek()].map((entry) => [entry.number, entry]));
    this.replace([...byNumber.values()].sort((a, b) => a.number - b.number));
  }

  /** Have exactly these entries. @param {Entry[]} entries */
  replace(entries) {
    const now = this.entries.peek();
    const isSame = entries.length === now.length && entries.at(-1)?.number === now.at(-1)?.number;
    if (!isSame) this.entries.value = entries.slice(-LINES_KEPT);
  }

  clear() {
    this.entries.value = [];
  }
}

/** @returns {State & { known: boolean }} */
const unknown = () => ({
  known: false, phase: "idle", time: 0, plan: 0, map: 0, fleet: 0, said: "", how: null, busy: "",
});

/** What is known of one flight. */
export class World {
  constructor() {
    this.state = signal(unknown());
    /** @type {Rows<MissionRow>} */
    this.missions = new Rows("name");
    /** @type {Rows<DroneRow>} */
    this.drones = new Rows("id");
    /** @type {Rows<Alert>} */
    this.alerts = new Rows("id");
    /** @type {Rows<TrackRow>} what moves beside the drones */
    this.tracks = new Rows("id");
    /** @type {Rows<EventRow>} what has happened, the oldest first */
    this.events = new Rows("id");
    /** @type {Tail<LogLine>} */
    this.log = new Tail();
    /** @type {Tail<Result>} */
    this.results = new Tail();
    /** @type {Signal<Person[]>} */
    this.people = signal([]);
    /** The flight's id; empty: none. */
    this.flight = signal("");
  }

  /** Take what has changed; what is left out stays. @param {Partial<LiveMessage> & Pick<LiveMessage, "state">} message */
  take(message) {
    batch(() => {
      if (message.flight !== undefined && message.flight !== this.flight.peek()) {
        this.clear();
        this.flight.value = message.flight;
      }
      this.state.value = { ...message.state, known: true };
      this.missions.take(message.missions ?? []);
      this.drones.take(message.drones ?? []);
      this.alerts.take(message.alerts ?? []);
      if (message.tracks) this.tracks.replace(message.tracks);
      if (message.events?.length) {
        this.events.take(message.events);
        this.events.replace(this.events.all().slice(-EVENTS_KEPT));
      }
      this.log.take(message.log ?? []);
      this.results.take(message.results ?? []);
      this.results.amend(message.amended ?? []);
      if (message.people) this.people.value = message.people;
    });
  }

  /** Forget the flight, but not how the station stands. */
  clear() {
    batch(() => {
      const { missions, drones, alerts, tracks, events, log, results } = this;
      for (const part of [missions, drones, alerts, tracks, events, log, results]) part.clear();
      this.flight.value = "";
    });
  }
}

/** @param {string} phase */
export const isFlying = (phase) => phase === "flying" || phase === "stopping";

const ENDED = ["COMPLETED", "FAILED", "CANCELLED"];
/** @param {MissionRow} row */
export const hasEnded = (row) => ENDED.includes(row.status);
