// Plans and templates that the station keeps under names: the plan is saved as one, and they are opened.

import { signal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { send, StationError } from "../core/api.js";
import { many, moment, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { mayFly, plan, tell, tellError } from "../core/station.js";
import { Button, Check, Chip, Dialog, Empty, Input, Problem } from "../ui/parts.js";
import { take } from "./commands.js";

const isOpen = signal(false);
/** @type {Signal<SavedPlans | null>} */
const kept = signal(null);

/** @param {string} name */
const at = (name) => `/api/plans?${new URLSearchParams({ name })}`;

/** Ask the station, which answers with all plans as they are then; returns whether it was done. @param {() => Promise<{ status: number, data: any }>} ask */
async function change(ask) {
  try {
    const { status, data } = await ask();
    if (!data.plans) throw new StationError(data.said, status);
    kept.value = data;
    return true;
  } catch (error) {
    tellError(error);
    return false;
  }
}

/** Put a plan into the trash, from where it comes back. @param {SavedPlan} plan */
async function remove({ name }) {
  if (!await change(() => send("DELETE", at(name)))) return;
  const gone = kept.peek()?.trash.find((one) => one.name === name);
  tell(t("library.deleted", { plan: name }), { settles: true, undo: gone ? () => { restore(gone); } : null });
}

/** @param {TrashedPlan} gone */
const restore = ({ id }) => change(() => send("POST", "/api/plans/restore", { id }));

/** @param {SavedPlan} one @param {boolean} add beside what is drawn, or in place of it */
async function open({ name }, add) {
  await take((revision) => send("POST", "/api/plans/open", { name, revision, add }), t("library.opened", { plan: name }));
  isOpen.value = false;
}

export const LibraryButton = ({ small = true }) => h(Button, {
  small, expanded: isOpen.value, onClick: () => { isOpen.value = !isOpen.peek(); },
}, t("library.title"));

export function Library() {
  return isOpen.value ? h(Opened, null) : null;
}

function Opened() {
  useEffect(() => { change(() => send("GET", "/api/plans")); }, []);
  const { plans, trash } = kept.value ?? { plans: [], trash: [] };
  return h(Dialog, { title: t("library.title"), class: "library", onClose: () => { isOpen.value = false; } },
    mayFly.value && plan.missions.value.length > 0 && h(Save, null),
    kept.value && !plans.length && h(Empty, null, t("library.empty")),
    h("ul", { class: "saved-plans", "aria-label": t("library.title") }, plans.map((one) => h(Item, { key: one.name, one }))),
    trash.length > 0 && h("details", null, h("summary", null, t("library.trash", { n: trash.length })),
      h("ul", { class: "saved-plans" }, trash.map((gone) => h("li", { key: gone.id, class: "row" },
        h("span", { class: "called" }, gone.name), h("span", { class: "hint" }, moment(gone.deleted_at)),
        mayFly.value && h("span", { class: "spread" }, h(Button, { small: true, onClick: () => { restore(gone); } }, t("library.restore"))))))));
}

/** @param {{ one: SavedPlan }} props */
function Item({ one }) {
  const { name, saved_at: at_, by, missions, template, said } = one;
  const about = [missions !== null && many("many.missions", missions), moment(at_), by].filter(Boolean).join(" · ");
  return h("li", { class: "saved-plan" },
    h("div", { class: "row" }, h("strong", { class: "called" }, name), template && h(Chip, null, t("library.template"))),
    h("p", { class: "hint" }, about), said && h(Problem, { text: said }),
    mayFly.value && h("div", { class: "row" },
      missions !== null && h(Button, { small: true, kind: "primary", onClick: () => { open(one, template); } }, t(template ? "library.add" : "library.open")),
      missions !== null && h(Button, { small: true, onClick: () => { open(one, !template); } }, t(template ? "library.open" : "library.add")),
      h(Button, { small: true, onClick: () => { remove(one); } }, t("delete"))));
}

/** Keeps the plan under a name. */
function Save() {
  const [name, setName] = useState("");
  const [template, setTemplate] = useState(false);
  const isThere = kept.value?.plans.some((one) => one.name === name.trim()) ?? false;
  /** @param {SubmitEvent} event */
  async function submit(event) {
    event.preventDefault();
    await plan.saved();
    const given = { by: prefs.name.peek(), template, replace: isThere };
    if (!await change(() => send("PUT", at(name.trim()), given))) return;
    tell(t("library.saved", { plan: name.trim() }), { settles: true });
    setName("");
  }
  return h("form", { class: "save-plan stack", onSubmit: submit },
    h("div", { class: "field" }, h("label", { for: "plan-name" }, t("library.name")), h(Input, {
      class: "", id: "plan-name", value: name, required: true, maxLength: 80, autocomplete: "off", onText: setName,
    })),
    h("div", { class: "row" },
      h(Check, { checked: template, onTick: setTemplate }, t("library.as-template")),
      h("span", { class: "spread" }, h(Button, { type: "submit", kind: "primary" }, t(isThere ? "library.replace" : "library.save")))));
}
