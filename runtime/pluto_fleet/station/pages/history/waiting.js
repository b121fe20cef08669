// What stands where something is still on its way, or could not be had.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { Icon } from "../ui/icon.js";

/** @param {{ trouble: string }} props */
export const Waiting = ({ trouble }) => (trouble
  ? h("p", { class: "problem replay-trouble", role: "alert" }, h(Icon, { name: "warning" }), trouble)
  : h("p", { class: "muted replay-trouble", role: "status" }, t("history.loading")));
