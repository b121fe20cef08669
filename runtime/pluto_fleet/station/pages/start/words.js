// What Start would do now, whether it can be pressed, and why not. Pure, but for the texts.

import { many, t, tOr } from "../core/i18n.js";
import { toFly } from "../core/plan.js";

/** A problem with the mission and the trip that it is about. @param {PlanMission[]} missions @param {ShownProblem} problem */
export function inFull(missions, { mission: key, trip, text }) {
  const mission = missions.find((one) => one.key === key);
  const name = mission?.name.trim() || t("plan.a");
  const n = mission && trip ? mission.trips.findIndex((one) => one.key === trip) + 1 : 0;
  return n ? t("plan.at-trip", { mission: name, n, text }) : t("plan.at-mission", { mission: name, text });
}

/**
 * @param {State & { known: boolean }} state
 * @param {{ missions: PlanMission[], problems: ShownProblem[], isLoaded: boolean }} plan
 * @param {DroneRow[]} drones
 * @param {boolean} mayFly
 * @returns {StartWords}
 */
export function startWords(state, { missions, problems, isLoaded }, drones, mayFly) {
  const { phase, busy, how, said, known } = state;
  const flying = phase === "flying";
  const todo = toFly(missions, flying);
  const isOpen = todo.some(({ ended }) => ended !== "COMPLETED");
  const bad = problems.filter(({ mission }) => mission === null || todo.some(({ key }) => key === mission));
  const text = !todo.length || phase === "stopping" ? t("start")
    : t(flying ? "start.new" : "start.missions", { n: todo.length });
  const lost = drones.filter(({ status }) => status === "LOST");
  const other = (!mayFly && t("start.watching"))
    || (busy && tOr(`start.busy.${busy}`, busy))
    || (phase === "stopping" && how && t(`start.down.${how}`))
    || (phase === "stopped" && t("start.stopped"))
    || (phase === "interrupted" && (said || t("start.interrupted")))
    || (!todo.length && t(flying ? "start.nothing-more" : "start.nothing"))
    || (!flying && lost.length > 0 && lost.length === drones.length && t("start.all-lost")) || "";
  const problem = (!other && bad[0]) || null;
  const first = problem && inFull(todo, problem);
  const why = other || (first && (bad.length > 1 ? t("plan.and-more", { text: first, more: bad.length - 1 }) : first));
  const some = !flying && isOpen && todo.length < missions.length;
  const hint = [
    some && t(todo.some(({ ended }) => ended) ? "start.from-beginning" : "start.leaves-out"),
    !isOpen && todo.length > 0 && !flying && t("start.again"),
    !flying && lost.length > 0 && t("start.without", { drones: lost.map(({ id }) => id) }),
  ].filter(Boolean).join(" ");
  return { text, can: !why && isLoaded && known, said: known && isLoaded ? why || hint : "", problem };
}

/** "2 missions, 5 trips". @param {PlanMission[]} missions */
export const counted = (missions) => [
  many("many.missions", missions.length),
  many("many.trips", missions.reduce((sum, { trips }) => sum + trips.length, 0)),
].join(", ");
