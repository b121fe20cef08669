// What says, on all that is of the past or was never flown, that it is not what flies now.

import { h } from "preact";
import { duration, moment } from "../core/format.js";
import { t } from "../core/i18n.js";
import { Icon } from "../ui/icon.js";
import { Said } from "../ui/parts.js";

/** @param {{ isRehearsal: boolean, begunAt: number | null, seconds: number, said: string }} props */
export const Banner = ({ isRehearsal, begunAt, seconds, said }) => h("div", { class: "replay-banner", role: "note" },
  h(Icon, { name: "history" }),
  h("p", null, h("strong", null, isRehearsal ? t("history.rehearsal")
    : begunAt === null ? t("history.replay") : t("history.replay-of", { when: moment(begunAt) })),
  " ", h("span", null, t(isRehearsal ? "history.rehearsal-more" : "history.replay-more", { time: duration(seconds) })),
  said && h("span", { class: "hint" }, " ", h(Said, { text: said }))));
