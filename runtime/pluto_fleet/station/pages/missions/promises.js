// When a mission may begin, when it is due, and which others must have completed before.

import { h } from "preact";
import { useEffect, useId, useState } from "preact/hooks";
import { setField } from "../core/changes.js";
import { t } from "../core/i18n.js";
import { plan } from "../core/station.js";
import { Icon } from "../ui/icon.js";
import { Said } from "../ui/parts.js";
import { MissionField } from "./fields.js";

export const PROMISES = ["opens", "deadline", "after"];

/** @param {{ mission: PlanMission, wanted: boolean }} props wanted: it is to be opened */
export function Promises({ mission, wanted }) {
  const isMade = PROMISES.some((name) => mission[name] !== undefined);
  const [isOpen, open] = useState(isMade || wanted);
  useEffect(() => { if (isMade || wanted) open(true); }, [isMade, wanted]);
  return h("details", {
    class: "promises", open: isOpen,
    onToggle: (/** @type {Event} */ event) => open(/** @type {HTMLDetailsElement} */ (event.currentTarget).open),
  },
  h("summary", null, t("missions.promises")),
  h("div", { class: "fields" },
    h(MissionField, { mission, field: { name: "opens", type: "time", label: t("missions.opens"), hint: t("missions.opens-hint") } }),
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
    h("p", { class: "problem", id, hidden: !text }, h(Icon, { name: "warning" }), h(Said, { text, isOwn })));
}
