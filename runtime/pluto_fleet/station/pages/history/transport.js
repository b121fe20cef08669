// What moves a replay: play and pause, its speed, a slider over its time with marks where something
// went wrong, and the batteries under it.

import { h } from "preact";
import { clock, number, t } from "../core/i18n.js";
import { tell } from "../core/notices.js";
import { IconButton } from "../ui/parts.js";
import { BatteryChart } from "./battery_chart.js";
import { nextMark, SPEEDS } from "./playback.js";

/** @import { Mark, Playback } from "./playback.js" */

/** @param {{ playback: Playback, replay: Replay, marks: readonly Mark[], chosen: string | null }} props */
export function Transport({ playback, replay, marks, chosen }) {
  const isPlaying = playback.isPlaying.value;
  const { seconds } = replay;
  return h("div", { class: "transport", role: "group", "aria-label": t("history.tab.replay") },
    h("div", { class: "transport-buttons row" },
      h(IconButton, {
        icon: isPlaying ? "pause" : "start", kind: "primary", label: t(isPlaying ? "history.pause" : "history.play"),
        onClick: () => playback.toggle(),
      }),
      h("select", {
        class: "input speed", "aria-label": t("history.speed"), value: playback.speed.value,
        onChange: (/** @type {Event} */ { currentTarget }) => {
          playback.speed.value = Number(/** @type {HTMLSelectElement} */ (currentTarget).value);
        },
      }, SPEEDS.map((speed) => h("option", { key: speed, value: speed }, `${number(speed)} ×`))),
      h(Clock, { playback, seconds }),
      marks.length > 0 && h(Jump, { playback, marks, way: -1 }), marks.length > 0 && h(Jump, { playback, marks, way: 1 })),
    h("div", { class: "transport-time" },
      h(Slider, { playback, seconds }),
      h(Marks, { playback, marks, seconds }),
      h(BatteryChart, { batteries: replay.batteries, seconds, marks, chosen, time: playback.time })));
}

/** @param {{ playback: Playback, seconds: number }} props */
const Clock = ({ playback, seconds }) => h("span", { class: "num replay-clock" },
  h("strong", null, clock(playback.time.value)), " / ", clock(seconds));

/** @param {{ playback: Playback, seconds: number }} props */
function Slider({ playback, seconds }) {
  const time = playback.time.value;
  return h("input", {
    type: "range", class: "scrubber", min: 0, max: seconds, step: 0.001, value: time, "aria-label": t("history.time"),
    "aria-valuetext": t("history.time-of", { time: clock(time), all: clock(seconds) }),
    onInput: (/** @type {Event} */ { currentTarget }) =>
      playback.set(Number(/** @type {HTMLInputElement} */ (currentTarget).value)),
  });
}

/** @param {{ playback: Playback, marks: readonly Mark[], seconds: number }} props */
const Marks = ({ playback, marks, seconds }) => h("div", { class: "marks" }, marks.map(({ time, text }) => h("button", {
  type: "button", key: time, class: "mark-button", tabIndex: -1, title: `${clock(time)}  ${text}`, "aria-label": `${clock(time)} ${text}`,
  style: { left: `${(time / (seconds || 1)) * 100}%` }, onClick: () => playback.set(time),
})));

/** To the next thing that went wrong, or the one before. @param {{ playback: Playback, marks: readonly Mark[], way: 1 | -1 }} props */
const Jump = ({ playback, marks, way }) => h(IconButton, {
  icon: way === 1 ? "next" : "previous", label: t(way === 1 ? "history.next-incident" : "history.previous-incident"),
  onClick: () => {
    const mark = nextMark(marks, playback.time.peek(), way);
    if (mark) playback.set(mark.time);
    tell(mark?.text ?? t("history.no-more-incidents"));
  },
});
