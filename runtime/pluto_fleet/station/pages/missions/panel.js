// The selected mission: its name, its fields, its promises, and what is done with it; or several.

import { h } from "preact";
import { useEffect, useId, useState } from "preact/hooks";
import { setField } from "../core/changes.js";
import { many, t } from "../core/i18n.js";
import { app, mayFly, plan, selected } from "../core/station.js";
import { preflight, start } from "../start/commands.js";
import { Field } from "../ui/field.js";
import { Button, HoldButton, Icon, Problem, Said } from "../ui/parts.js";
import { Touching } from "../ui/people.js";
import { copy, marked, open, remove, selectedInWords, unlocked } from "./commands.js";
import { actionsOf, ownFirst } from "./words.js";

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

const MOST_TOLD = 5; // problems

/** @param {{ wanted: string | null }} props the field that is to be seen */
export function Panel({ wanted }) {
  if (marked.value.length > 1) return h(Several, null);
  const mission = selected.value;
  return mission ? h(One, { key: mission.key, mission, wanted }) : h("section", { class: "card stack" },
    h("h2", null, t("missions.none-selected")), h("p", null, t("missions.select-one")),
    h("p", { class: "hint" }, t("missions.double-click")));
}

/** Starts missions alone: held down at once, pressed after a look. @param {{ keys: string[], label: string }} props */
function StartOnly({ keys, label }) {
  const can = unlocked(keys).length === keys.length;
  const isWrong = plan.problems.value.some(({ mission }) => mission !== null && keys.includes(mission));
  return h(HoldButton, {
    kind: "", icon: "start", why: can ? null : t("missions.locked"), onHold: () => { start(keys); },
    onPress: () => {
      if (!can) return;
      if (isWrong) start(keys); // which leads to the field
      else preflight.value = { missions: keys };
    },
  }, label);
}

function Several() {
  const keys = [...marked.value];
  const free = unlocked(keys).length;
  return h("section", { class: "card mission-panel stack", "aria-label": t("missions.panel-many") },
    h("h2", null, selectedInWords()),
    mayFly.value && h("div", { class: "row" },
      h(StartOnly, { keys, label: t("missions.start-these", { n: keys.length }) }),
      h(Button, { onClick: () => copy(keys) }, t("copy")),
      h(Button, { disabled: !free, onClick: () => remove(keys) }, t("delete"))),
    free < keys.length && h("p", { class: "hint" }, t("missions.locked-some")));
}

/** @param {{ mission: PlanMission, wanted: string | null }} props */
function One({ mission, wanted }) {
  const { key, launched, trips } = mission;
  const { fields } = /** @type {AppShape} */ (app.value);
  const known = ["name", ...PROMISES, ...fields.mission.map(({ name }) => name)];
  const told = trips.length ? plan.problems.value.filter((one) =>
    one.mission === key && (one.trip || !known.includes(one.field ?? ""))) : [];
  /** @param {KeyboardEvent} event */
  function toTrips(event) {
    if (event.key !== "Enter") return;
    event.preventDefault();
    /** @type {HTMLElement | null} */ (document.querySelector(".mission-panel .set-trips"))?.focus();
  }
  return h("section", { class: "card mission-panel stack", "aria-label": t("missions.panel") },
    launched && h("p", { class: "row" }, h(Icon, { name: "lock" }), t("missions.locked")),
    h("div", { class: "panel-title" },
      h(MissionField, { mission, field: { name: "name", type: "text", label: t("name") }, onKeyDown: toTrips }),
      h(Touching, { keys: [key] })),
    told.length > 0 && h("div", { class: "stack" }, told.slice(0, MOST_TOLD).map(({ trip, text, isOwn }) => {
      const n = trips.findIndex((one) => one.key === trip) + 1;
      return h("p", { key: `${trip} ${text}`, class: "problem" }, h(Icon, { name: "warning" }),
        h(Said, { text: n ? t("missions.at-trip", { n, text }) : text, isOwn }));
    })),
    fields.mission.length > 0 && h("div", { class: "fields" },
      ownFirst(fields.mission).map((field) => h(MissionField, { key: field.name, mission, field }))),
    h(Promises, { mission, wanted: PROMISES.includes(wanted ?? "") }),
    h("div", { class: "row" },
      h("h3", null, trips.length ? many("many.trips", trips.length) : t("page.trips")),
      h("span", { class: "spread" }, h(Button, { kind: "primary", class: "set-trips", onClick: () => open(key) },
        t(launched ? "missions.see-trips" : "missions.set-trips")))),
    h("p", { class: "hint" }, trips.length ? actionsOf(trips) : t("missions.no-trips-yet")),
    mayFly.value && h("div", { class: "row" },
      h(StartOnly, { keys: [key], label: t("missions.start-these", { n: 1 }) }),
      h(Button, { onClick: () => copy([key]) }, t("copy")),
      h(Button, { disabled: launched, onClick: () => remove([key]) }, t("delete"))));
}

export const PROMISES = ["opens", "deadline", "after"];

/** @param {{ mission: PlanMission, wanted: boolean }} props wanted: it is to be opened */
export function Promises({ mission, wanted }) {
  const isMade = PROMISES.some((name) => mission[name] !== undefined);
  const [isOpen, setOpen] = useState(isMade || wanted);
  useEffect(() => { if (isMade || wanted) setOpen(true); }, [isMade, wanted]);
  return h("details", {
    class: "promises", open: isOpen,
    onToggle: (/** @type {Event} */ event) => setOpen(/** @type {HTMLDetailsElement} */ (event.currentTarget).open),
  },
  h("summary", null, t("missions.promises")),
  h("div", { class: "fields" },
    h(MissionField, { mission, field: { name: "opens", type: "time", label: t("missions.opens"), hint: t("missions.deadline-hint") } }),
    h(MissionField, { mission, field: { name: "deadline", type: "time", label: t("missions.deadline"), hint: t("missions.deadline-hint") } }),
    h(After, { mission })));
}

/** Each of the other missions, with a box to tick. @param {{ mission: PlanMission }} props */
function After({ mission: { key, launched, after = [] } }) {
  const id = useId();
  const others = plan.missions.value.filter((one) => one.key !== key).map(({ name }) => name);
  const { text = "", isOwn } = plan.problems.value.find((one) => one.mission === key && !one.trip && one.field === "after") ?? {};
  const names = [...new Set([...others, ...after])];
  if (!names.length) return null;
  /** @param {string} name */
  function tick(name) {
    const next = after.includes(name) ? after.filter((one) => one !== name) : [...after, name];
    plan.edit(setField(key, "after", next.length ? next : undefined));
  }
  return h("fieldset", { class: "field", "data-field": "after", disabled: launched, "aria-describedby": id },
    h("legend", null, t("missions.begins-after")),
    h("div", { class: "choices" }, names.map((name) => h("label", { key: name, class: "check" },
      h("input", { type: "checkbox", value: name, checked: after.includes(name), onChange: () => tick(name) }),
      h("span", { class: "called" }, name)))),
    h(Problem, { id, hidden: !text, text, isOwn }));
}
