// The messages of the page, at its foot.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { badNotice, goodNotice, spoken } from "../core/notices.js";
import { Button, IconButton } from "../ui/button.js";
import { Icon } from "../ui/icon.js";
import { Said } from "../ui/parts.js";

/** @import { Notice } from "../core/notices.js" */

/** @param {{ notice: Signal<Notice | null> }} props */
function Shown({ notice }) {
  const now = notice.value;
  if (!now) return null;
  const away = () => { notice.value = null; };
  return h("div", { class: `notice ${now.bad ? "bad" : ""}` },
    h(Icon, { name: now.bad ? "bad" : "info" }), h("p", null, h(Said, { text: now.text, isOwn: !now.isSaid })),
    now.undo && h(Button, { small: true, onClick: () => { away(); now.undo?.(); } }, t("undo")),
    h(IconButton, { icon: "close", label: t("notice.close"), onClick: away }));
}

export const Notices = () => h("div", { class: "notices" },
  h("div", { role: "alert" }, h(Shown, { notice: badNotice })),
  h("div", { role: "status" }, h(Shown, { notice: goodNotice })),
  h("div", { class: "unseen", role: "status" }, spoken.value));
