// The plan that everybody draws together.
//
//   const plan = planKept();          await plan.load();
//   plan.missions                     [{ key, name, launched, trips, … }…]: never changed in place
//   plan.problems                     [{ mission: key|null, trip: key|null, field, text }…]
//   plan.edit(change)                 change: missions → missions, seen at once, saved by itself
//   plan.edit(change, true)           the same while somebody types: saved after a moment
//   plan.changed.heard(() => …)       the plan has changed, here or elsewhere
//   plan.unsaved() · plan.trouble     is something not saved yet? · why, in words, or ""
//   plan.said                         what is wrong with keeping it at the station, or ""
//   plan.refused.heard((said) => …)   the station would not have it; the plan is as it was before
//
// Somebody else may change the plan meanwhile: then our changes are made to theirs, and sent again.
// So a change must find what it changes by its key, and leave all alone where that has gone;
// plan_edits.js has the usual ones. What is changed without a connection is kept, and sent later.

import { bell } from "./bell.js";
import { get, send } from "./api.js";

const TYPING = 300;
const BETWEEN = 120; // ms between two savings, also while a pin is dragged

export function planKept() {
  let base = { revision: 0, missions: [], problems: [] };
  let pending = []; // changes that the station does not know yet
  let timer = 0;
  let sending = false;
  let tries = 0;
  let sentAt = -BETWEEN;

  const plan = {
    missions: [], problems: [], said: "", trouble: "", loaded: false,
    changed: bell(), refused: bell(),
  };

  function replay() {
    plan.missions = pending.reduce((missions, change) => change(missions), base.missions);
    plan.problems = base.problems;
    plan.changed.ring();
  }

  function take(fresh) {
    base = fresh;
    plan.loaded = true;
    plan.said = fresh.said ?? "";
    plan.trouble = "";
    tries = 0;
    replay();
  }

  function later(time) {
    clearTimeout(timer);
    timer = setTimeout(save, Math.max(time, sentAt + BETWEEN - performance.now()));
  }

  async function save() {
    clearTimeout(timer);
    if (sending || !pending.length || !plan.loaded) return;
    sending = true;
    sentAt = performance.now();
    const sent = pending.length;
    try {
      const content = { revision: base.revision, missions: plan.missions };
      const { status, data } = await send("PUT", "/api/plan", content);
      if (status !== 409) pending = pending.slice(sent);
      take(data);
    } catch (error) {
      refuse(error, sent);
    }
    sending = false;
    if (pending.length) later(tries ? Math.min(2000, 250 * 2 ** tries) : 0);
  }

  function refuse(error, sent) {
    if (error.status === 400 || error.status === 413) {
      pending = pending.slice(sent);
      replay();
      plan.refused.ring(error.message);
      return;
    }
    tries = Math.min(tries + 1, 3);
    plan.trouble = error.message;
    plan.changed.ring();
  }

  // What we have not sent yet is made to what came from the station.
  plan.take = take;
  plan.load = async () => {
    if (!sending) {
      const fresh = await get("/api/plan");
      if (!sending && (!plan.loaded || fresh.revision !== base.revision)) take(fresh);
    }
    if (pending.length) later(0);
  };
  plan.revision = () => base.revision;
  plan.unsaved = () => pending.length > 0;
  // Resolves when all that was changed here is saved, or after `time` ms.
  plan.saved = async (time = 3000) => {
    const until = performance.now() + time;
    if (pending.length) later(0);
    while (pending.length && performance.now() < until) {
      await new Promise((done) => setTimeout(done, 30));
    }
    return !pending.length;
  };
  plan.edit = (change, typing = false) => {
    pending.push(change);
    plan.missions = change(plan.missions);
    plan.changed.ring();
    later(typing ? TYPING : 0);
  };
  return plan;
}
