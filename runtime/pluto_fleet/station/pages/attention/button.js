// How many things want attention, on every page and in the title of the tab.

import { computed, effect, signal } from "@preact/signals";
import { h } from "preact";
import { t } from "../core/i18n.js";
import { app, world } from "../core/station.js";
import { Icon } from "../ui/icon.js";

/** Whether the list is open. */
export const isOpen = signal(false);

/** What is not over yet, the urgent first, then the newest. */
export const open = computed(() => world.alerts.all().filter(({ over }) => !over)
  .toSorted((a, b) => Number(b.urgent) - Number(a.urgent) || b.since_at - a.since_at));

/** What is neither over nor acknowledged. */
export const unheeded = computed(() => open.value.filter(({ by }) => by === null));

effect(() => {
  const n = unheeded.value.length;
  const title = app.value?.title ?? "Pluto";
  const { phase, known } = world.state.value;
  document.title = `${n ? `(${n}) ` : ""}${known && phase !== "idle" ? `${t(`phase.${phase}`)} · ` : ""}${title}`;
});

effect(() => { // the tab has the same logo as the head
  const icon = document.querySelector("link[rel=icon]");
  if (app.value?.logo) icon?.setAttribute("href", app.value.logo);
});

export function AttentionButton() {
  const n = unheeded.value.length;
  const urgent = unheeded.value.some((alert) => alert.urgent);
  return h("button", {
    type: "button", class: `button attention ${n ? (urgent ? "bad" : "warn") : "quiet"}`,
    "aria-expanded": isOpen.value, "aria-label": t("attention.button", { n }), title: t("attention.button", { n }),
    onClick: () => { isOpen.value = !isOpen.value; },
  }, h(Icon, { name: "bell" }), n > 0 && h("span", { class: "num" }, n));
}
