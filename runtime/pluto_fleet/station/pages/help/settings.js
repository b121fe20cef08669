// What this browser remembers of its user: language, looks, name, and how it draws attention.

import { h } from "preact";
import { allowNotifications, beep } from "../attention/alarm.js";
import { forgetToken, token } from "../core/api.js";
import { LANGUAGES, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { Button } from "../ui/button.js";
import { touring } from "./tour.js";

/** @param {{ id: string, label: string, value: Signal<any>, choices: [string, string][] }} props */
const Choice = ({ id, label, value, choices }) => h("div", { class: "field" },
  h("label", { for: id }, label),
  h("select", {
    id, value: value.value,
    onChange: (/** @type {Event} */ event) => { value.value = /** @type {HTMLSelectElement} */ (event.target).value; },
  }, choices.map(([name, text]) => h("option", { key: name, value: name }, text))));

/** @param {{ label: string, value: Signal<boolean>, onChange?: (yes: boolean) => void }} props */
const Switch = ({ label, value, onChange }) => h("label", { class: "check" }, h("input", {
  type: "checkbox", checked: value.value,
  onChange: (/** @type {Event} */ event) => {
    const { checked } = /** @type {HTMLInputElement} */ (event.target);
    value.value = checked;
    onChange?.(checked);
  },
}), label);

export function Settings() {
  return h("section", { class: "card stack", "aria-labelledby": "settings" },
    h("h2", { id: "settings" }, t("settings")),
    h("div", { class: "fields" },
      h("div", { class: "field" }, h("label", { for: "own-name" }, t("settings.name")),
        h("input", {
          id: "own-name", maxlength: 60, autocomplete: "name", value: prefs.name.value,
          placeholder: t("settings.name-hint"),
          onChange: (/** @type {Event} */ event) => { prefs.name.value = /** @type {HTMLInputElement} */ (event.target).value.trim(); },
        })),
      h(Choice, {
        id: "language", label: t("settings.language"), value: prefs.language,
        choices: [["", t("settings.language-auto")], ...Object.entries(LANGUAGES)],
      }),
      h(Choice, {
        id: "theme", label: t("settings.theme"), value: prefs.theme,
        choices: [["auto", t("settings.theme-auto")], ["light", t("settings.light")], ["dark", t("settings.dark")]],
      }),
      h(Choice, {
        id: "contrast", label: t("settings.contrast"), value: prefs.contrast,
        choices: [["auto", t("settings.contrast-auto")], ["more", t("settings.contrast-more")]],
      })),
    h("div", { class: "stack" },
      h(Switch, { label: t("settings.sound"), value: prefs.sound, onChange: (yes) => { if (yes) beep(); } }),
      h(Switch, { label: t("settings.notify"), value: prefs.notify, onChange: (yes) => { if (yes) allowNotifications(); } }),
      h(Switch, { label: t("settings.graph"), value: prefs.graph })),
    h("div", { class: "row" },
      h(Button, { onClick: () => { touring.value = 0; } }, t("settings.tour")),
      token.value && h(Button, {
        onClick: () => {
          forgetToken();
          location.reload();
        },
      }, t("settings.forget"))));
}
