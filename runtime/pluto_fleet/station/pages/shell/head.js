// The head of every page: the app, its pages, how it stands, and what flies or stops it.

import { h } from "preact";
import { AttentionButton } from "../attention/attention.js";
import { clock, t } from "../core/i18n.js";
import { go, page, PAGES } from "../core/route.js";
import { app, line, plan, world } from "../core/station.js";
import { isFlying } from "../core/world.js";
import { leadTo, StartButtons, Stops, words } from "../start/commands.js";
import { Chip, Icon, Said, Tabs } from "../ui/parts.js";

/** @import { PageName } from "../core/route.js" */

/** @type {Record<string, ["" | "good" | "warn" | "info", IconName]>} */
const PHASES = {
  idle: ["info", "info"], flying: ["good", "start"], stopping: ["warn", "wait"],
  stopped: ["warn", "pause"], over: ["info", "good"], interrupted: ["warn", "warning"],
};
/** @type {Record<PageName, IconName>} */
export const SIGNS = {
  missions: "list", trips: "pin", monitor: "map", results: "chart", history: "history", map: "settings",
  help: "help",
};

export function Head() {
  return h("header", { class: "head" },
    h(Title, null),
    h(Pages, null),
    h(Standing, null),
    h(Liveness, null),
    h(Why, null),
    h("div", { class: "fly", role: "group", "aria-label": t("start.group") },
      h(AttentionButton, null), h(StartButtons, null), h(Stops, null)));
}

/** What the station is called, and the logo of whose it is. */
function Title() {
  const { title = "Pluto", logo = null } = app.value ?? {};
  return h("h1", { class: "title" }, logo && h("img", { class: "logo", src: logo, alt: "" }), h("span", null, title));
}

const Pages = () => h(Tabs, {
  label: t("pages"), names: PAGES, now: page.value, onPick: go, controls: (name) => `page-${name}`,
  title: (/** @type {PageName} */ name) => [h(Icon, { name: SIGNS[name] }), h("span", { class: "tab-words" }, t(`page.${name}`))],
});

function Standing() {
  const { known, phase, time } = world.state.value;
  const [kind, icon] = PHASES[phase];
  return h("div", { class: "standing" },
    h("span", { role: "status" }, known
      ? h(Chip, { kind, icon }, t(`phase.${phase}`)) : h(Chip, { icon: "wait" }, t("phase.unknown"))),
    (isFlying(phase) || time > 0) && h("span", { class: "num" }, clock(time)));
}

/** Whether what is seen is simulated, saved, and of now. */
function Liveness() {
  const { sim = false, speed = 1 } = app.value ?? {};
  const faster = speed === 1 ? {} : { speed };
  return h("div", { class: "liveness" },
    sim && h(Chip, null,
      h("span", { class: "wide-only" }, t("simulated.at", faster)),
      h("span", { class: "narrow-only", title: t("simulated.at") }, t("simulated.short", faster))),
    plan.trouble.value && h(Chip, { kind: "warn" }, t("plan.unsaved")),
    h(Age, null));
}

function Age() {
  const age = line.age.value;
  const seconds = Math.round(age / 1000);
  if (!world.state.value.known) return h(Chip, { kind: "warn" }, t("live.none"));
  return h(Chip, { kind: line.isLost.value ? "bad" : age < 1500 ? "good" : "warn" },
    age < 1500 ? t("live.now") : t("live.old", { seconds }));
}

/** Why Start waits, or what it would leave out. */
function Why() {
  const { said, problem } = words.value;
  if (!said) return h("span", { class: "why" });
  return h("span", { class: "why" }, problem
    ? h("button", { type: "button", class: "link", onClick: () => leadTo(problem) }, h(Said, { text: said, isOwn: problem.isOwn }))
    : h("span", { class: "muted" }, said));
}

/** What stays in sight as long as the station does not answer. */
export function LostLine() {
  const isLost = world.state.value.known && line.isLost.value;
  const seconds = Math.round(line.age.value / 1000);
  return h("div", { class: "lost-line", role: "alert" }, isLost && [
    h(Icon, { name: "warning" }),
    h("p", null, t("live.lost", { seconds }))]);
}
