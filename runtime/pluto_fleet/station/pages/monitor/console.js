// What happens, line by line, to be searched. It follows the newest line, until one scrolls up.

import { computed, useSignal } from "@preact/signals";
import { h } from "preact";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { clock, many, t } from "../core/i18n.js";
import { save, selectMission } from "../core/station.js";
import { Button, IconButton, Input, Said, Select } from "../ui/parts.js";

const SHOWN = 500; // lines
const KINDS = /** @type {const} */ (["all", "info", "good", "bad", "hook"]);
const SIGNS = { good: "✓", bad: "!", hook: "›", info: "" };
const NEAR = 8; // pixels from the end that count as being there

/** @param {{ world: World, live: boolean }} props */
export function Console({ world, live }) {
  const text = useSignal("");
  const kind = useSignal(/** @type {typeof KINDS[number]} */ ("all"));
  const isFollowing = useSignal(true);
  const readTo = useRef(0);
  const list = useRef(/** @type {HTMLDivElement | null} */ (null));
  const lines = useMemo(() => computed(() => {
    const wanted = text.value.toLowerCase();
    return world.log.entries.value.filter(({ mission, text: said, kind: its }) =>
      (kind.value === "all" || its === kind.value) && `${mission ?? ""} ${said}`.toLowerCase().includes(wanted)).slice(-SHOWN);
  }), [world, text, kind]);
  const shown = lines.value;
  const last = shown.at(-1)?.number ?? 0;
  useLayoutEffect(() => {
    if (!isFollowing.value || !list.current) return;
    list.current.scrollTop = list.current.scrollHeight;
    readTo.current = last;
  }, [last, isFollowing.value]);
  const unread = isFollowing.value ? 0 : shown.filter((line) => line.number > readTo.current).length;
  return h("div", { class: "console" },
    h("div", { class: "row console-tools" },
      h(Input, {
        type: "search", "aria-label": t("log.find"), placeholder: t("log.find"), value: text.value, onText: (now) => { text.value = now; },
      }),
      h(Select, {
        "aria-label": t("log.which"), value: kind.value, options: KINDS.map((one) => [one, t(`log.kind.${one}`)]),
        onPick: (one) => { kind.value = one; },
      }),
      live && h(IconButton, { icon: "save", label: t("log.download"), onClick: () => { save("/api/console.txt", "console.txt"); } })),
    h("div", {
      ref: list, class: "log", role: "log", "aria-live": "off", "aria-label": t("monitor.log"), tabIndex: 0,
      onScroll: () => {
        const { scrollTop, clientHeight, scrollHeight } = /** @type {HTMLDivElement} */ (list.current);
        isFollowing.value = scrollTop + clientHeight >= scrollHeight - NEAR;
      },
    }, shown.map((line) => h(Line, { key: line.number, line }))),
    unread > 0 && h(Button, { small: true, class: "newest", onClick: () => { isFollowing.value = true; } },
      many("many.lines", unread)));
}

/** @param {{ line: LogLine }} props */
const Line = ({ line: { time, mission, text, kind } }) => h("p", { class: `log-line ${kind}` },
  h("span", { class: "when num" }, clock(time)),
  h("span", { class: "sign", "aria-hidden": true }, SIGNS[kind]),
  mission !== null && h("button", { type: "button", class: "link", onClick: () => selectMission(mission) }, mission),
  h(Said, { class: "said", text, isOwn: kind === "hook" }));
