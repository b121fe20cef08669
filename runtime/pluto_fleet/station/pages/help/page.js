// Help: the three steps, what the colours and signs mean, the keys, and the settings of this browser.

import { h } from "preact";
import { allowNotifications, beep } from "../attention/attention.js";
import { forgetToken, token } from "../core/api.js";
import { LANGUAGES, t, tOr } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { Button, Check, Select, Standing } from "../ui/parts.js";
import { Step, Steps, touring } from "./tour.js";

const DRONES = ["FREE", "BUSY", "RETURNING", "CHARGING", "LOW", "UNKNOWN", "LOST", "RETIRED"];
/** @type {readonly (readonly [string[], "keys.tabs" | "keys.map" | "keys.zoom" | "keys.whole" | "keys.pins" | "keys.fine" | "keys.delete" | "keys.undo" | "keys.reorder" | "keys.open" | "keys.hold" | "keys.close" | "keys.actions" | "keys.places" | "keys.new" | "keys.several"])[]} */
const KEYS = [
  [["←", "→"], "keys.tabs"], [["←", "→", "↑", "↓"], "keys.map"], [["+", "−"], "keys.zoom"], [["0"], "keys.whole"],
  [["←", "→", "↑", "↓"], "keys.pins"], [["Shift"], "keys.fine"], [["Delete"], "keys.delete"],
  [["Ctrl+Z", "Ctrl+Y"], "keys.undo"], [["Alt+↑", "Alt+↓"], "keys.reorder"], [["Enter"], "keys.open"],
  [["1", "9"], "keys.actions"], [["↓"], "keys.places"], [["N"], "keys.new"], [["Ctrl+A", "Ctrl+D"], "keys.several"],
  [["Space"], "keys.hold"], [["Esc"], "keys.close"],
];

/** "Ctrl+Z", as the reader's keyboard calls it. @param {string} key */
const named = (key) => key.split(/(?<=.)\+/).map((one) => tOr(`key.${one}`, one)).join("+");

export default function Help() {
  return h("div", { class: "help-columns" },
    h("section", { class: "card stack", "aria-labelledby": "steps" },
      h("h2", { id: "steps" }, t("help.steps")),
      h(Steps, { class: "stack" }),
      h("div", null, h(Step, { name: "stop" }))),
    h(Settings, null),
    h("section", { class: "card stack", "aria-labelledby": "signs" },
      h("h2", { id: "signs" }, t("help.signs")),
      h("dl", { class: "signs" }, DRONES.map((status) => h("div", { key: status },
        h("dt", null, h(Standing, { status })), h("dd", { class: "muted" }, t(/** @type {any} */ (`help.${status}`))))))),
    h("section", { class: "card stack", "aria-labelledby": "keys" },
      h("h2", { id: "keys" }, t("help.keys")),
      h("table", { class: "table" }, h("tbody", null, KEYS.map(([keys, what]) => h("tr", { key: what },
        h("td", null, keys.map((key) => h("kbd", { key, class: "key" }, named(key)))), h("td", null, t(what))))))));
}

/** @param {{ id: string, label: string, value: Signal<any>, choices: [string, string][] }} props */
const Choice = ({ id, label, value, choices }) => h("div", { class: "field" },
  h("label", { for: id }, label),
  h(Select, { class: "", id, value: value.value, options: choices, onPick: (picked) => { value.value = picked; } }));

/** @param {{ label: string, value: Signal<boolean>, onChange?: (yes: boolean) => void }} props */
const Switch = ({ label, value, onChange }) => h(Check, {
  checked: value.value, onTick: (yes) => {
    value.value = yes;
    onChange?.(yes);
  },
}, label);

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
        choices: [["auto", t("settings.auto")], ["light", t("settings.light")], ["dark", t("settings.dark")]],
      }),
      h(Choice, {
        id: "contrast", label: t("settings.contrast"), value: prefs.contrast,
        choices: [["auto", t("settings.auto")], ["more", t("settings.contrast-more")]],
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
