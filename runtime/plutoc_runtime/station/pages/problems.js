// What is wrong with a plan, at the places where it is: the station's problems by mission and trip.

import { h } from "./dom.js";
import { icon } from "./dom.js";

/** → { own: [{field, text}…] of the mission itself, trips: Map of key → [{field, text}…] } */
export function problemsOf(plan, mission) {
  const own = [];
  const trips = new Map();
  for (const problem of plan.problems) {
    if (problem.mission !== mission) continue;
    if (problem.trip === null) own.push(problem);
    else if (trips.has(problem.trip)) trips.get(problem.trip).push(problem);
    else trips.set(problem.trip, [problem]);
  }
  return { own, trips };
}

/** A sentence with its sign, so that it is not told by its colour alone. */
export const problemLine = (text) =>
  h("p", { class: "problem" }, icon("warning"), h("span", {}, text));

/** The problems that stand at a field ("target", "item.mass"), in one text. */
export const textOf = (problems, field) =>
  problems.filter((problem) => problem.field === field).map((problem) => problem.text).join(" ");
