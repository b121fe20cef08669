// What one tells missions apart by, and how far each of them is, in words. Pure, but for the texts.

import { inWords, many, plain, t, TIME } from "../core/i18n.js";

/** @param {{ name: string }} mission */
export const called = ({ name }) => name.trim() || t("missions.unnamed");

/** "2 trips · Amato · due 20 min · after Bed 1". @param {PlanMission} mission @param {FieldShape[]} fields */
export function inShort({ trips, deadline, after = [], ...mission }, fields) {
  const texts = fields.filter(({ own, type }) => own && type === "text");
  return [
    trips.length ? many("many.trips", trips.length) : t("missions.no-trips"),
    ...texts.map(({ name }) => mission[name]),
    deadline !== undefined && t("missions.due", { time: inWords(deadline, TIME) }),
    after.length === 1 && t("missions.after", { mission: after[0] }),
    after.length > 1 && t("missions.after-many", { n: after.length }),
  ].filter(Boolean).join(" · ");
}

const MOST_SAID = 20;

/** "listen × 2, measure". @param {PlanTrip[]} trips */
export function actionsOf(trips) {
  /** @type {{ word: string, count: number }[]} */
  const runs = [];
  for (const { action } of trips) {
    const last = runs.at(-1);
    if (last?.word === action) last.count += 1;
    else runs.push({ word: action, count: 1 });
  }
  const said = runs.slice(0, MOST_SAID).map(({ word, count }) => plain(word) + (count > 1 ? ` × ${count}` : ""));
  return [...said, ...(runs.length > MOST_SAID ? ["…"] : [])].join(", ");
}

/** @type {Record<string, [IconName, "" | "good" | "warn" | "bad"]>} */
const ENDED = {
  COMPLETED: ["good", "good"], FAILED: ["bad", "bad"], CANCELLED: ["close", ""], BROKEN_OFF: ["warning", "warn"],
};

/**
 * How far a mission is; one that is only not finished yet has nothing wrong with it.
 * @param {PlanMission} mission @param {readonly ShownProblem[]} problems @param {FieldShape[]} fields
 * @returns {{ text: string, kind: "" | "good" | "warn" | "bad" | "info", icon?: IconName } | null}
 */
export function standing({ key, trips, launched, ended, ...mission }, problems, fields) {
  const own = problems.filter((problem) => problem.mission === key);
  const isEmpty = (/** @type {ShownProblem} */ { trip, field }) => !trip
    && fields.some(({ name, needed }) => needed && name === field && mission[name] === undefined);
  if (launched) return { text: t("missions.started"), kind: "info", icon: "lock" };
  if (own.some((one) => !isEmpty(one) && (trips.length || one.field))) {
    return { text: t("missions.to-mend"), kind: "warn", icon: "warning" };
  }
  if (own.length) return { text: t("status.WAITING"), kind: "" };
  const end = ended === null ? undefined : ENDED[ended];
  return end ? { text: t(/** @type {any} */ (`status.${ended}`)), kind: end[1], icon: end[0] } : null;
}

/** The fields, those of the app's own first. @param {FieldShape[]} fields */
export const ownFirst = (fields) => fields.toSorted((a, b) => Number(b.own ?? false) - Number(a.own ?? false));
