// Start, Resume and the two Stops, as buttons and as what they do.

import { computed, signal } from "@preact/signals";
import { h } from "preact";
import { command, ofStation } from "../core/api.js";
import { t } from "../core/i18n.js";
import { go, page, wantedField } from "../core/route.js";
import { line, mayFly, perform, plan, selectKey, tell, world } from "../core/station.js";
import { isFlying } from "../core/world.js";
import { Button, HoldButton } from "../ui/parts.js";
import { inFull, startWords } from "./words.js";

const STOP_FOR = 60000; // ms that a Stop is tried
const STOP_ALARM = 1500; // ms

/** What a Start is to fly, while its preflight is open: keys of missions, or null for what has not been completed. */
/** @type {Signal<{ missions: string[] | null } | null>} */
export const preflight = signal(null);

export const words = computed(() => startWords(world.state.value, {
  missions: plan.missions.value, problems: plan.problems.value, isLoaded: plan.isLoaded.value,
}, world.drones.all(), mayFly.value));

/** Go to the field where something is wrong. @param {ShownProblem} problem */
export function leadTo({ mission, trip, field }) {
  selectKey(mission, trip);
  wantedField.value = { trip, field };
  go(trip || (mission && !field) ? "trips" : "missions");
}

/**
 * Start missions: those with these keys, or what has not been completed; then go to the Monitor, unless
 * another page was opened meanwhile.
 * @param {string[] | null} [missions] @param {Record<string, unknown>} [more]
 */
export async function start(missions = null, more = {}) {
  const there = page.peek();
  const wrong = plan.problems.peek().find(({ mission }) => mission && missions?.includes(mission));
  if (wrong) {
    leadTo(wrong);
    tell(inFull(plan.missions.peek(), wrong), { bad: true, isSaid: !wrong.isOwn });
  } else if (!await plan.saved()) {
    tell(t("start.unsaved"), { bad: true });
  } else if (await perform("start", { revision: plan.revision, missions, ...more })) {
    preflight.value = null;
    if (page.peek() === there) go("monitor");
  }
  plan.load().catch(() => null); // it is asked again as long as the revisions differ
}

/** Bring all drones down; tried for a minute. @param {"rtl" | "land"} how */
export async function stop(how) {
  const alarm = setTimeout(() => tell(t("stop.trying"), { bad: true }), STOP_ALARM);
  try {
    tell(await command("stop", { how }, STOP_FOR), { isSaid: true, settles: true });
  } catch (error) {
    const { status, message, isSaid } = ofStation(error);
    tell(status ? message : t("stop.failed"), { bad: true, isSaid });
  } finally {
    clearTimeout(alarm);
  }
}

/** Whether a Stop may be needed: also where it is not known what flies. */
const mayStop = computed(() => {
  const { known, phase } = world.state.value;
  return mayFly.value && (!known || line.isLost.value || isFlying(phase));
});

/** A text, and the shorter one that is shown instead where there is little room. @param {{ text: string, short: string }} props */
const Wide = ({ text, short }) => [
  h("span", { key: "text", class: "wide-only" }, text), h("span", { key: "short", class: "narrow-only" }, short)];

export function Stops() {
  if (!mayFly.value) return null;
  const disabled = !mayStop.value;
  return h("div", { class: "stops", role: "group", "aria-label": t("tour.stop") },
    h(Button, { kind: "danger", icon: "home", disabled, label: t("stop.home"), onClick: () => { stop("rtl"); } },
      h(Wide, { text: t("stop.home"), short: t("stop.home-short") })),
    h(Button, { kind: "danger", icon: "land", disabled, label: t("stop.land"), onClick: () => { stop("land"); } },
      h(Wide, { text: t("stop.land"), short: t("stop.land-short") })));
}

export function StartButtons() {
  if (!mayFly.value) return null;
  const { known, phase } = world.state.value;
  const { text, can, said, problem } = words.value;
  const able = can && !line.isLost.value;
  if (phase === "stopped" || phase === "interrupted") {
    const resume = async () => {
      const there = page.peek();
      if (await perform("resume") && page.peek() === there) go("monitor");
    };
    return h("div", { class: "starts" },
      h(Button, { kind: "primary", icon: "start", onClick: resume }, t("resume")),
      h(Button, { onClick: () => { perform("discard"); } }, t("put-away")));
  }
  const open = () => { preflight.value = { missions: null }; };
  return h("div", { class: "starts" }, h(HoldButton, {
    icon: "start", why: able ? null : said || t("live.none"), onHold: () => { start(); },
    onPress: () => (able ? open() : said && known && tell(said, { isSaid: problem !== null && !problem.isOwn })),
  }, text));
}
