// A flight of the past, or a rehearsal, as the Monitor showed it: at any instant, at any speed, with marks where
// something went wrong. Nothing can be commanded here.

import { useSignal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { get, ofStation } from "../core/api.js";
import { clock, duration, moment, number, t } from "../core/i18n.js";
import { selection, tell } from "../core/station.js";
import { World } from "../core/world.js";
import { Watch } from "../monitor/page.js";
import { useAnswer } from "../ui/hooks.js";
import { Button, Icon, IconButton, Input, Problem, Said, Select } from "../ui/parts.js";
import { Waiting } from "./asked.js";
import { BatteryChart } from "./battery_chart.js";
import { marksOf, nextMark, Playback, SPEEDS } from "./playback.js";
import { Replayer } from "./replayer.js";

/** @import { Mark } from "./playback.js" */

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
      h(Select, {
        class: "input speed", "aria-label": t("history.speed"), value: playback.speed.value,
        options: SPEEDS.map((speed) => [speed, `${number(speed)} ×`]), onPick: (speed) => { playback.speed.value = Number(speed); },
      }),
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
  return h(Input, {
    type: "range", class: "scrubber", min: 0, max: seconds, step: 0.001, value: time, "aria-label": t("history.time"),
    "aria-valuetext": t("history.time-of", { time: clock(time), all: clock(seconds) }),
    onText: (text) => playback.set(Number(text)),
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

const PATIENCE = 30000; // ms
const OWN_KEYS = "input, select, textarea, svg.floor-picture, [role=tablist], [role=log], [role=dialog]";

/** What says, on all that is of the past or was never flown, that it is not what flies now. @param {{ isRehearsal: boolean, begunAt: number | null, seconds: number, said: string }} props */
const Banner = ({ isRehearsal, begunAt, seconds, said }) => h("div", { class: "replay-banner", role: "note" },
  h(Icon, { name: "history" }),
  h("p", null, h("strong", null, isRehearsal ? t("history.rehearsal")
    : begunAt === null ? t("history.replay") : t("history.replay-of", { when: moment(begunAt) })),
  " ", h("span", null, t(isRehearsal ? "history.rehearsal-more" : "history.replay-more", { time: duration(seconds) })),
  said && h("span", { class: "hint" }, " ", h(Said, { text: said }))));

/** @param {string} flight */
const partsOf = (flight) => (/** @type {number} */ from) =>
  get(`/api/flights/replay?flight=${encodeURIComponent(flight)}&start=${from}`, PATIENCE);

/** The replay of a flight by its id, or of a rehearsal: `rehearsal-…`. @param {{ flight: string, from?: number, onTime?: (time: number) => void }} props */
export function ReplayView({ flight, from = 0, onTime }) {
  const replayer = useMemo(() => new Replayer(new World(), partsOf(flight)), [flight]);
  const [tries, again] = useState(0);
  const { data: replay, trouble } = useAnswer([replayer, tries], () => replayer.open());
  if (trouble) {
    return h("div", { class: "replay-trouble stack" }, h(Problem, { role: "alert", text: trouble }),
      h("div", null, h(Button, { onClick: () => again(tries + 1) }, t("history.again"))));
  }
  if (!replay) return h(Waiting, { trouble });
  return h(Player, { key: flight, replayer, replay, from, onTime, isRehearsal: flight.startsWith("rehearsal-") });
}

/** @param {{ replayer: Replayer, replay: Replay, from: number, isRehearsal: boolean, onTime?: (time: number) => void }} props */
function Player({ replayer, replay, from, onTime, isRehearsal }) {
  const playback = useMemo(() => new Playback(replay.seconds), [replay]);
  const marks = useMemo(() => marksOf(replay), [replay]);
  const waiting = useSignal(false);
  const element = useRef(/** @type {HTMLDivElement | null} */ (null));
  useEffect(() => {
    playback.set(from);
    element.current?.focus({ preventScroll: true });
  }, [playback, from]);

  useEffect(() => playback.time.subscribe((time) => { // show what was then, as soon as it is here
    onTime?.(time);
    if (replayer.show(time)) return;
    waiting.value = true;
    replayer.seek(time).then((isShown) => { if (isShown) waiting.value = false; }, (error) => {
      ofStation(error);
      playback.isPlaying.value = false; // pressed again, it is asked for again
      waiting.value = false;
    });
  }), [playback, replayer, waiting, onTime]);

  useEffect(() => {
    let [frame, last] = [0, 0];
    const run = (/** @type {number} */ now) => {
      if (!waiting.peek()) {
        playback.tick(last ? (now - last) / 1000 : 0);
        replayer.ahead(playback.time.peek(), playback.speed.peek());
      }
      last = now;
      frame = requestAnimationFrame(run);
    };
    const stop = playback.isPlaying.subscribe((isPlaying) => {
      cancelAnimationFrame(frame);
      last = 0;
      if (isPlaying) frame = requestAnimationFrame(run);
    });
    return () => {
      stop();
      cancelAnimationFrame(frame);
    };
  }, [playback, replayer, waiting]);

  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const target = /** @type {Element} */ (event.target);
    const isButton = event.key === " " && target.closest("button, a, [role=button]");
    const isOwn = target.closest(OWN_KEYS) && !target.matches(".scrubber");
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || isButton || isOwn) return;
    if (playback.press(event)) event.preventDefault();
  }
  return h("div", { class: "replay", ref: element, tabIndex: -1, onKeyDown, "data-flight": replay.flight },
    h(Banner, { isRehearsal, begunAt: replay.begun_at, seconds: replay.seconds, said: replay.said }),
    h("div", { class: "replay-watch" }, h(Watch, {
      world: replayer.world, isLive: false, foot: waiting.value && h("p", { key: "wait", class: "replay-waits card", role: "status" }, t("loading")),
    })),
    h(Transport, { playback, replay, marks, chosen: selection.value.drone }));
}
