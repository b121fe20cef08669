// What wants attention: how many things, on every page and in the title of the tab; their list, with why, since
// when, and who has seen each; and a sound and a notification of the browser for what is new and urgent, each
// only where it was asked for.

import { computed, effect, signal } from "@preact/signals";
import { h } from "preact";
import { moment, say, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { go } from "../core/route.js";
import { app, mayFly, perform, selectDrone, selectMission, world } from "../core/station.js";
import { Button, Dialog, Empty, Icon, SaidWords } from "../ui/parts.js";

/** Whether the list is open. */
export const isOpen = signal(false);

/** What is not over yet, the urgent first, then the newest. */
export const open = computed(() => world.alerts.all().filter(({ over }) => !over)
  .toSorted((a, b) => Number(b.urgent) - Number(a.urgent) || b.since_at - a.since_at));

/** What is neither over nor acknowledged. */
export const unheeded = computed(() => open.value.filter(({ by }) => by === null));

effect(() => {
  const n = unheeded.value.length;
  const title = app.value?.title ?? "Pluto";
  const { phase, known } = world.state.value;
  document.title = `${n ? `(${n}) ` : ""}${known && phase !== "idle" ? `${t(`phase.${phase}`)} · ` : ""}${title}`;
});

effect(() => { // the tab has the same logo as the head
  const icon = document.querySelector("link[rel=icon]");
  if (app.value?.logo) icon?.setAttribute("href", app.value.logo);
});

export function AttentionButton() {
  const n = unheeded.value.length;
  const urgent = unheeded.value.some((alert) => alert.urgent);
  return h("button", {
    type: "button", class: `button attention ${n ? (urgent ? "bad" : "warn") : "quiet"}`,
    "aria-expanded": isOpen.value, "aria-label": t("attention.button", { n }), title: t("attention.button", { n }),
    onClick: () => { isOpen.value = !isOpen.value; },
  }, h(Icon, { name: "bell" }), n > 0 && h("span", { class: "num" }, n));
}

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
        alert.by !== null && ` · ${t("attention.by", { who: alert.by || t("people.unnamed") })}`)),
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
  title: t("tour.attention"), class: "attention-list", onClose: () => { isOpen.value = false; },
}, open.value.length
  ? h("ul", null, open.value.map((alert) => h(Item, { key: alert.id, alert })))
  : h(Empty, null, t("attention.none")));

const TONES = [880, 660]; // Hz
const TONE = 0.18; // seconds

/** Two short tones, made here: no file is asked for. */
export function beep() {
  const audio = new AudioContext();
  TONES.forEach((frequency, i) => {
    const [tone, volume] = [audio.createOscillator(), audio.createGain()];
    const from = audio.currentTime + i * TONE * 1.3;
    tone.frequency.value = frequency;
    volume.gain.setValueAtTime(0.15, from);
    volume.gain.exponentialRampToValueAtTime(0.001, from + TONE);
    tone.connect(volume).connect(audio.destination);
    tone.start(from);
    tone.stop(from + TONE);
    if (i === TONES.length - 1) tone.onended = () => { audio.close(); };
  });
}

/** Ask the browser, once, whether it may notify; it is off where it may not. */
export async function allowNotifications() {
  prefs.notify.value = "Notification" in window && await Notification.requestPermission() === "granted";
}

/** Sound and notify of what is new from now on. */
export function alarm() {
  /** @type {Set<string> | null} what has been told; null: what is there at the beginning is not new */
  let told = null;
  effect(() => {
    const urgent = unheeded.value.filter((alert) => alert.urgent);
    const fresh = told === null ? [] : urgent.filter(({ id }) => !told?.has(id));
    told = new Set(urgent.map(({ id }) => id));
    if (!fresh.length) return;
    if (prefs.sound.peek()) beep();
    if (!prefs.notify.peek() || Notification.permission !== "granted") return;
    for (const alert of fresh) new Notification(app.peek()?.title ?? "Pluto", { body: say(alert.said), tag: alert.id });
  });
}
