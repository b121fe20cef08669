// The selected mission: its name, its fields, its promises, and what is done with it; or several.

import { h } from "preact";
import { many } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app, mayFly, plan, selected } from "../core/station.js";
import { preflight, start } from "../start/commands.js";
import { Button, HoldButton } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { Said } from "../ui/parts.js";
import { Touching } from "../ui/people.js";
import { copy, open, remove, selectedInWords, unlocked } from "./commands.js";
import { MissionField } from "./fields.js";
import { marked } from "./marked.js";
import { Promises, PROMISES } from "./promises.js";
import { actionsOf, ownFirst } from "./words.js";

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
      h(Button, { onClick: () => copy(keys) }, t("missions.copy")),
      h(Button, { disabled: !free, onClick: () => remove(keys) }, t("missions.delete"))),
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
      h(MissionField, { mission, field: { name: "name", type: "text", label: t("missions.name") }, onKeyDown: toTrips }),
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
      h(StartOnly, { keys: [key], label: t("missions.start-only") }),
      h(Button, { onClick: () => copy([key]) }, t("missions.copy")),
      h(Button, { disabled: launched, onClick: () => remove([key]) }, t("missions.delete"))));
}
