// What is seen in place of the pages, where the station wants its token or refuses; what opens over every page:
// the preflight of a Start, the list of what wants attention, the tour; and the messages at its foot.

import { h } from "preact";
import { AttentionList, isOpen } from "../attention/attention.js";
import { keepToken, token } from "../core/api.js";
import { t } from "../core/i18n.js";
import { badNotice, goodNotice, spoken } from "../core/station.js";
import { Tour, touring } from "../help/tour.js";
import { preflight } from "../start/commands.js";
import { Preflight } from "../start/preflight.js";
import { Button, Icon, IconButton, Problem, Said } from "../ui/parts.js";

/** @param {{ status: number, message: string }} props */
export function Gate({ status, message }) {
  /** @param {SubmitEvent} event */
  function open(event) {
    event.preventDefault();
    const form = /** @type {HTMLFormElement} */ (event.currentTarget);
    keepToken(String(new FormData(form).get("token")));
    location.reload();
  }
  return h("main", { class: "gate" }, h("div", { class: "card stack" },
    h("h1", null, status === 401 ? t("gate.title") : message),
    status === 401 && h("form", { class: "stack", onSubmit: open },
      h("p", null, t("gate.where")),
      h("div", { class: "field" }, h("label", { for: "token" }, t("gate.field")),
        h("input", { id: "token", name: "token", type: "password", autocomplete: "off", required: true })),
      token.value && h(Problem, { role: "alert", text: t("gate.wrong"), isOwn: true }),
      h("div", null, h(Button, { kind: "primary", type: "submit" }, t("gate.open"))))));
}

export const Over = () => h("div", { class: "over" },
  preflight.value && h(Preflight, preflight.value), isOpen.value && h(AttentionList, null),
  touring.value !== null && h(Tour, null));

/** @param {{ notice: Signal<Notice | null> }} props */
function Shown({ notice }) {
  const now = notice.value;
  if (!now) return null;
  const away = () => { notice.value = null; };
  return h("div", { class: `notice ${now.bad ? "bad" : ""}` },
    h(Icon, { name: now.bad ? "bad" : "info" }), h("p", null, h(Said, { text: now.text, isOwn: !now.isSaid })),
    now.undo && h(Button, { small: true, onClick: () => { away(); now.undo?.(); } }, t("undo")),
    h(IconButton, { icon: "close", label: t("close"), onClick: away }));
}

export const Notices = () => h("div", { class: "notices" },
  h("div", { role: "alert" }, h(Shown, { notice: badNotice })),
  h("div", { role: "status" }, h(Shown, { notice: goodNotice })),
  h("div", { class: "unseen", role: "status" }, spoken.value));
