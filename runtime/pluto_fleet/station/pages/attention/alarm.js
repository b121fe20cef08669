// A sound and a notification of the browser for what is new and urgent: each only where it was asked for.

import { effect } from "@preact/signals";
import { say } from "../core/said.js";
import { prefs } from "../core/prefs.js";
import { app } from "../core/station.js";
import { unheeded } from "./button.js";

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
