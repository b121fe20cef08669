// A drone that joins the flight that is under way.

import { h } from "preact";
import { useRef } from "preact/hooks";
import { typedNumber } from "../core/format.js";
import { t } from "../core/i18n.js";
import { app, perform } from "../core/station.js";
import { Button } from "../ui/button.js";

export function Join() {
  const { categories, sim } = /** @type {AppShape} */ (app.value);
  const form = useRef(/** @type {HTMLFormElement | null} */ (null));
  /** @param {SubmitEvent} event */
  async function submit(event) {
    event.preventDefault();
    const given = new FormData(/** @type {HTMLFormElement} */ (form.current));
    const text = (/** @type {string} */ name) => String(given.get(name) ?? "").trim();
    const home = ["x", "y"].map((name) => typedNumber(text(name)));
    const uri = text("uri");
    const isDone = await perform("join", {
      drone: text("drone"), category: text("category"), home, ...(uri ? { uri } : {}),
    });
    if (isDone) form.current?.reset();
  }
  const field = (/** @type {string} */ name, /** @type {string} */ label, isNeeded = true) => h("div", { class: "field" },
    h("label", { for: `join-${name}` }, label),
    h("input", { id: `join-${name}`, name, required: isNeeded, autocomplete: "off", maxlength: 200 }));
  return h("details", { class: "join" }, h("summary", null, t("join.title")),
    h("form", { ref: form, class: "stack", onSubmit: submit },
      h("div", { class: "fields" },
        field("drone", t("join.drone")),
        h("div", { class: "field" }, h("label", { for: "join-category" }, t("join.category")),
          h("select", { id: "join-category", name: "category" },
            categories.map(({ name }) => h("option", { key: name, value: name }, name)))),
        field("x", t("join.x")), field("y", t("join.y")), !sim && field("uri", t("join.uri"), false)),
      h("div", null, h(Button, { type: "submit", small: true }, t("join.add")))));
}
