// The preflight of a Start: what will fly, for how long, and what is not ready.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { toFly } from "../core/plan.js";
import { plan, world } from "../core/station.js";
import { HoldButton } from "../ui/button.js";
import { Dialog } from "../ui/parts.js";
import { preflight, start } from "./commands.js";
import { counted } from "./words.js";

/** @param {{ missions: string[] | null }} props */
export function Preflight({ missions: keys }) {
  const all = plan.missions.value;
  const missions = keys ? all.filter(({ key }) => keys.includes(key))
    : toFly(all, world.state.value.phase === "flying");
  return h(Dialog, {
    title: t("preflight.title"), class: "preflight", onClose: () => { preflight.value = null; },
    foot: h(HoldButton, { icon: "start", onHold: () => { start(keys); }, onPress: () => null }, t("preflight.hold")),
  }, h("p", null, counted(missions)));
}
