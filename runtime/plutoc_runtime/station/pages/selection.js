// Which mission is selected, on all pages alike. A tab that is loaded again remembers it.
//
//   selected.key            the mission's key in the plan, or null
//   selected.set(key)       selected.changed.heard(() => …)
//   selected.mission()      the mission itself, or null

import { bell } from "./bell.js";

const NAME = "pluto-selected";

export function selection(plan) {
  const selected = { key: sessionStorage.getItem(NAME), changed: bell() };
  selected.mission = () => plan.missions.find((mission) => mission.key === selected.key) ?? null;
  selected.set = (key) => {
    if (key === selected.key) return;
    selected.key = key;
    if (key === null) sessionStorage.removeItem(NAME);
    else sessionStorage.setItem(NAME, key);
    selected.changed.ring();
  };
  plan.changed.heard(() => {
    if (plan.loaded && selected.key !== null && !selected.mission()) selected.set(null);
  });
  return selected;
}
