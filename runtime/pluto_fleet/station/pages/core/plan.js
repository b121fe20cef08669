// The plan that all draw together. A change is seen at once and saved by itself; where another page was
// quicker, it is made again on top of theirs; without a connection, it is saved later.

import { batch, signal } from "@preact/signals";
import { get, ofStation, pause, send } from "./api.js";
import { leaves } from "./changes.js";
import { t } from "./i18n.js";

const TYPING = 300; // ms until what is being typed is saved
const BETWEEN = 120; // ms between two savings, also while a pin is dragged
const MOST_TOLD = 3; // collisions in one message

export class PlanStore {
  /**
   * @param {(text: string) => void} refused told what the station did not take, or what collided
   * @param {(before: PlanMission[], after: PlanMission[], typing: boolean) => void} [edited] told what is drawn here
   */
  constructor(refused, edited = () => undefined) {
    this.refused = refused;
    this.edited = edited;
    /** @type {Signal<PlanMission[]>} */
    this.missions = signal([]);
    /** @type {Signal<ShownProblem[]>} */
    this.problems = signal([]);
    /** What is wrong with keeping it at the station. */
    this.said = signal("");
    /** Why it is not saved; empty: it is, or soon will be. */
    this.trouble = signal("");
    this.isLoaded = signal(false);
    /** @type {PlanShape} */
    this.base = { revision: 0, missions: [], problems: [], said: "" };
    /** @type {Change[]} changes that the station does not know yet */
    this.pending = [];
    /** @type {PlanMission[]} what the station may have got all the same */
    this.unanswered = [];
    /** @type {Map<string, PlacedDraft>} by where they stand */
    this.drafts = new Map();
    this.timer = 0;
    this.isSending = false;
    this.tries = 0;
    this.sentAt = -BETWEEN;
  }

  get revision() { return this.base.revision; }

  get isSaved() { return !this.pending.length; }

  /** @param {string | null} key */
  mission(key) {
    return this.missions.value.find((mission) => mission.key === key) ?? null;
  }

  /** What is wrong, what was typed in vain first. */
  judge() {
    /** @type {ShownProblem[]} */
    const found = [];
    for (const [at, { mission, trip, field, typed, why, now }] of this.drafts) {
      const of = this.missions.peek().find(({ key, launched }) => key === mission && (trip !== null || !launched));
      const thing = trip ? of?.trips.find(({ key }) => key === trip) : of;
      if (!thing) this.drafts.delete(at);
      else {
        const kept = now(thing) ?? t("plan.nothing-there");
        found.push({ mission, trip, field, text: t("plan.still-has", { why, kept }), typed, isOwn: true });
      }
    }
    this.problems.value = [...found, ...this.base.problems];
  }

  /** Make the pending changes again, on what the station has. */
  replay() {
    batch(() => {
      this.missions.value = this.pending.reduce((missions, change) => change(missions), this.base.missions);
      this.said.value = this.base.said ?? "";
      this.judge();
    });
  }

  /** Tell where two have written at one place. @param {PlanMission[]} old @param {PlanMission[]} ours */
  tell(old, ours) {
    const [was, mine, theirs, lost, now] =
      [old, ours, this.base.missions, this.unanswered, this.missions.peek()].map(leaves);
    /** @type {string[]} */
    const told = [];
    for (const [at, value] of mine) {
      const other = theirs.get(at);
      if (value === was.get(at)) continue;
      if (now.get(at) !== value) told.push(t("plan.removed-meanwhile", { value }));
      else if (![was.get(at), value, lost.get(at)].includes(other)) {
        told.push(t("plan.both-wrote", { value, other: other ?? "" }));
      }
    }
    if (told.length) this.refused(told.slice(0, MOST_TOLD).join("\n"));
  }

  /** @param {number} time ms */
  later(time) {
    clearTimeout(this.timer);
    const soonest = this.sentAt + BETWEEN - performance.now();
    this.timer = setTimeout(() => this.save(), Math.max(time, soonest));
  }

  async save() {
    clearTimeout(this.timer);
    if (this.isSending || !this.pending.length || !this.isLoaded.peek()) return;
    this.isSending = true;
    this.sentAt = performance.now();
    const sent = this.pending.length;
    const content = { revision: this.base.revision, missions: this.missions.peek() };
    try {
      const { status, data } = await send("PUT", "/api/plan", content);
      const [old, ours] = [this.base.missions, this.missions.peek()];
      if (status !== 409) this.pending = this.pending.slice(sent);
      this.take(data);
      if (status === 409) this.tell(old, ours);
      this.unanswered = [];
    } catch (error) {
      this.failed(error, sent, content.missions);
    }
    this.isSending = false;
    if (this.pending.length) this.later(this.tries ? Math.min(2000, 250 * 2 ** this.tries) : 0);
  }

  /** @param {unknown} error @param {number} sent @param {PlanMission[]} missions */
  failed(error, sent, missions) {
    const { status, message } = ofStation(error);
    if ([400, 403, 413].includes(status)) { // the station will never have it
      this.pending = this.pending.slice(sent);
      this.replay();
      this.refused(message);
    } else {
      this.tries = Math.min(this.tries + 1, 3);
      this.unanswered = missions;
      this.trouble.value = message;
    }
  }

  /** @param {PlanShape} fresh */
  take(fresh) {
    this.base = fresh;
    this.tries = 0;
    batch(() => {
      this.isLoaded.value = true;
      this.trouble.value = "";
      this.replay();
    });
  }

  async load() {
    const fresh = await get("/api/plan");
    if (!this.isSending && (!this.isLoaded.peek() || fresh.revision !== this.base.revision)) this.take(fresh);
    if (this.pending.length) this.later(0);
  }

  /** Wait until the station has every change; returns whether it has. */
  async saved() {
    if (this.pending.length) this.later(0);
    for (let i = 0; this.pending.length && i < 100; i += 1) await pause(30);
    return !this.pending.length;
  }

  /** @param {Change} change @param {boolean} [typing] more of the same is likely to come at once */
  edit(change, typing = false) {
    this.edited(this.missions.peek(), this.make(change, typing), typing);
  }

  /** Make a change that is no step of its own: one that undoes another. @param {Change} change @param {boolean} [typing] */
  make(change, typing = false) {
    this.pending.push(change);
    batch(() => {
      this.missions.value = change(this.missions.peek());
      this.judge();
    });
    this.later(typing ? TYPING : 0);
    return this.missions.peek();
  }

  /** @param {string} mission @param {string | null} trip @param {string} field @param {Draft | null} draft */
  draft(mission, trip, field, draft) {
    const at = [mission, trip, field].join();
    if (!draft && !this.drafts.delete(at)) return;
    if (draft) this.drafts.set(at, { mission, trip, field, ...draft });
    this.judge();
  }
}

/** The missions that a Start would fly. @param {PlanMission[]} missions @param {boolean} flying */
export function toFly(missions, flying) {
  const open = missions.filter(({ launched, ended }) => !launched && ended !== "COMPLETED");
  return open.length || flying ? open : missions;
}
