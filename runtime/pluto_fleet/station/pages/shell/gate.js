// What is seen in place of the pages, where the station wants its token, or refuses.

import { h } from "preact";
import { keepToken, token } from "../core/api.js";
import { t } from "../core/i18n.js";
import { Button } from "../ui/button.js";
import { Icon } from "../ui/icon.js";

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
      token.value && h("p", { class: "problem", role: "alert" }, h(Icon, { name: "warning" }), t("gate.wrong")),
      h("div", null, h(Button, { kind: "primary", type: "submit" }, t("gate.open"))))));
}
