// The list of what wants attention: why, since when, and who has seen it.

import { h } from "preact";
import { moment } from "../core/format.js";
import { t } from "../core/i18n.js";
import { go } from "../core/route.js";
import { mayFly, perform, selectDrone, selectMission } from "../core/station.js";
import { Button } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { Dialog, Empty, SaidWords } from "../ui/parts.js";
import { isOpen, open } from "./button.js";

/** @param {{ alert: Alert }} props */
function Item({ alert }) {
  const show = () => {
    if (alert.drone) selectDrone(alert.drone);
    else if (alert.mission) selectMission(alert.mission);
    isOpen.value = false;
    go("monitor");
  };
  return h("li", { class: `alert ${alert.urgent ? "urgent" : ""}` },
    h(Icon, { name: alert.urgent ? "warning" : "info" }),
    h("div", null, h("p", null, h(SaidWords, { words: alert.said })),
      h("p", { class: "hint" }, moment(alert.since_at),
        alert.by !== null && ` · ${t("attention.by", { who: alert.by || t("attention.unnamed") })}`)),
    h("div", { class: "row" },
      (alert.drone || alert.mission) && h(Button, { small: true, kind: "quiet", onClick: show }, t("attention.show")),
      alert.by === null && mayFly.value && h(Button, {
        small: true, onClick: (event) => { // it goes with that, and must not take the focus along
          /** @type {HTMLElement} */ (event.currentTarget).closest("dialog")?.focus();
          perform("acknowledge", { alert: alert.id });
        },
      }, t("attention.acknowledge"))));
}

export const AttentionList = () => h(Dialog, {
  title: t("attention.title"), class: "attention-list", onClose: () => { isOpen.value = false; },
}, open.value.length
  ? h("ul", null, open.value.map((alert) => h(Item, { key: alert.id, alert })))
  : h(Empty, null, t("attention.none")));
