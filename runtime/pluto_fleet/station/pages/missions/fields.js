// A field of a mission, joined to the plan.

import { h } from "preact";
import { setField } from "../core/changes.js";
import { app, mayFly, plan } from "../core/station.js";
import { Field } from "../ui/field.js";

/** @param {{ mission: PlanMission, field: FieldShape, onKeyDown?: (event: KeyboardEvent) => void }} props */
export function MissionField({ mission, field, onKeyDown }) {
  const { key, launched } = mission;
  const problem = plan.problems.value.find((one) => one.mission === key && !one.trip && one.field === field.name);
  return h(Field, {
    key: `${key} ${field.name}`, field, value: problem?.typed ?? mission[field.name], problem: problem?.text ?? "", isOwn: problem?.isOwn,
    locked: launched || !mayFly.value, evaluators: app.value?.evaluators ?? [], onKeyDown,
    onChange: (value, typing, wrong) => {
      plan.draft(key, null, field.name, wrong && { ...wrong, now: (one) => one[field.name] });
      if (wrong) return;
      plan.edit(setField(key, field.name, field.name === "name" ? value ?? "" : value), typing);
    },
  });
}
