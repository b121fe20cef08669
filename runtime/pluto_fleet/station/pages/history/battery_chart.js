// The batteries over a flight: a line for each drone, and marks where something went wrong. An SVG of our
// own: uPlot as an ES module is 42 kB gzipped, as much as these two pages together, and draws on a canvas,
// which is printed as pixels.

import { h } from "preact";
import { useMemo } from "preact/hooks";
import { clock, percent, t } from "../core/i18n.js";
import { linesOf } from "./playback.js";

/** @import { Mark } from "./playback.js" */

/**
 * @param {object} props
 * @param {Record<string, number[][]>} props.batteries
 * @param {number} props.seconds
 * @param {readonly Mark[]} props.marks
 * @param {string | null} [props.chosen] the drone that stands out
 * @param {ReadonlySignal<number>} [props.time] where the replay is
 */
export function BatteryChart({ batteries, seconds, marks, chosen, time }) {
  const lines = useMemo(() => linesOf(batteries, seconds), [batteries, seconds]);
  if (!lines.length) return h("p", { class: "hint" }, t("history.no-levels"));
  const lowest = lines.reduce((low, line) => (line.lowest < low.lowest ? line : low));
  const label = t("history.levels-label", { drone: lowest.drone, level: percent(lowest.lowest) });
  return h("div", { class: "battery-chart" },
    h("svg", { viewBox: "0 0 1000 100", preserveAspectRatio: "none", role: "img", "aria-label": label },
      [0, 50, 100].map((y) => h("line", { key: y, class: "level-line", x1: 0, x2: 1000, y1: y, y2: y })),
      h("rect", { class: "level-low", x: 0, y: 80, width: 1000, height: 20 }),
      marks.map((mark) => h("line", {
        key: mark.time, class: "mark-line", x1: (mark.time / seconds) * 1000, x2: (mark.time / seconds) * 1000, y1: 0, y2: 100,
      })),
      lines.map(({ drone, points }) => h("polyline", {
        key: drone, points, class: drone === chosen ? "level chosen" : "level", "data-drone": drone,
      }, h("title", null, drone))),
      time && h(Now, { time, seconds })),
    h("div", { class: "chart-words num", "aria-hidden": true }, h("span", null, percent(1)), h("span", null, percent(0))));
}

/** @param {{ time: ReadonlySignal<number>, seconds: number }} props */
function Now({ time, seconds }) {
  const x = (time.value / (seconds || 1)) * 1000;
  return h("line", { class: "now", x1: x, x2: x, y1: 0, y2: 100 });
}

/** The times under a chart. @param {{ seconds: number }} props */
export const Times = ({ seconds }) => h("div", { class: "chart-times num hint", "aria-hidden": true },
  h("span", null, clock(0)), h("span", null, clock(seconds / 2)), h("span", null, clock(seconds)));
