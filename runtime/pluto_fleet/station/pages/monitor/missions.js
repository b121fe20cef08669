// The missions of the flight: how each stands, and why; the one that is open shows its trips.

import { computed, useSignal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { capital, duration, inWords, isTranslated, number, plain, roughly, say, t } from "../core/i18n.js";
import { app, mayFly, perform, plan, selectDrone, selection, selectMission } from "../core/station.js";
import { hasEnded } from "../core/world.js";
import { start } from "../start/commands.js";
import { Gap, useLongList } from "../ui/long_list.js";
import {
  Battery, Button, Chip, Empty, IconButton, Input, Said, Standing, SureButton, toneOf, walking,
} from "../ui/parts.js";

/** A trip's name, or its action if it was given none. @param {TripRow} trip @param {number} index */
export const calledTrip = (trip, index) =>
  (trip.name === String(index + 1) ? capital(trip.action) : trip.name);

/** "2 of 5: kitchen". @param {MissionRow} row */
export function progress({ trips, current, done, total }) {
  const trip = current === null ? undefined : trips[current];
  return trip ? t("monitor.trip-of", { n: (current ?? 0) + 1, total, trip: calledTrip(trip, current ?? 0) })
    : t("monitor.done-of", { done, total });
}

/** Why it stands as it does, and whether in the reader's language. @param {MissionRow} row @param {number} now */
export function why({ status, reason, question, wait, until }, now) {
  const words = question?.said ?? (reason || status === "PAUSED" ? null : wait);
  const text = words ? say(words) : reason;
  return {
    text: until !== null && until > now ? `${text} (${duration(until - now)})` : text,
    isOwn: words !== null && isTranslated(words),
  };
}

/** @param {MissionRow} row @param {number} now */
export const due = ({ late, due: at }, now) => {
  if (late) return t("monitor.late");
  return at === null ? "" : t("monitor.due-in", { time: roughly(Math.max(0, at - now)) });
};

/** "take photo at 1.5; 2", or "take photo: track t7". @param {TripRow} trip */
export const done = ({ action, x, y, track }) => (track ? `${plain(action)}: ${t("event.track", { track })}`
  : t("monitor.action-at", { action: plain(action), x: number(x), y: number(y) }));

/** @type {Record<string, (row: MissionRow) => boolean>} */
const FILTERS = {
  all: () => true,
  flying: ({ status }) => status === "RUNNING",
  waiting: (row) => !hasEnded(row) && row.status !== "RUNNING",
  ended: hasEnded,
  trouble: ({ status, late, question }) => status === "FAILED" || late || question !== null,
};
const MANY = 8; // missions from which on they can be searched

/** @param {{ world: World, live: boolean }} props */
export function MissionList({ world, live }) {
  const filter = useSignal("all");
  const text = useSignal("");
  const names = useMemo(() => computed(() => {
    const wanted = text.value.trim().toLowerCase();
    return world.missions.all()
      .filter((row) => FILTERS[filter.value](row) && row.name.toLowerCase().includes(wanted))
      .sort((a, b) => a.index - b.index).map(({ name }) => name).join("\n");
  }), [world, filter, text]);
  const counts = useMemo(() => computed(() => {
    const rows = world.missions.all();
    return Object.fromEntries(Object.entries(FILTERS).map(([name, fits]) => [name, rows.filter(fits).length]));
  }), [world]);
  const total = world.missions.keys.value.length;
  if (!total) return h(Empty, null, t(live ? nothingYet() : "monitor.no-missions"));
  const shown = names.value ? names.value.split("\n") : [];
  return h("div", { class: "mission-rows" },
    total > MANY && h(Input, {
      type: "search", "aria-label": t("monitor.find-mission"), placeholder: t("monitor.find-mission"), value: text.value,
      onText: (now) => { text.value = now; },
    }),
    h("div", { class: "sieve", role: "group", "aria-label": t("monitor.which-missions") },
      Object.keys(FILTERS).map((name) => h("button", {
        type: "button", key: name, class: "sift", "aria-pressed": filter.value === name,
        onClick: () => { filter.value = name; },
      }, t(/** @type {any} */ (`monitor.filter.${name}`)), " ", h("span", { class: "num" }, counts.value[name])))),
    h("ul", { "aria-label": t("monitor.missions"), onKeyDown: walking(".opener") }, shown.map((name) => h(Mission, { key: name, world, name, live }))),
    !shown.length && h(Empty, null, t("monitor.none-like-that")));
}

const nothingYet = () => (plan.missions.value.length ? "monitor.press-start" : "monitor.make-some");

/** @param {{ world: World, name: string, live: boolean }} props */
function Mission({ world, name, live }) {
  const row = /** @type {MissionRow} */ (world.missions.get(name));
  const { retries = false, rounds = false, fields } = /** @type {AppShape} */ (app.value);
  const isOpen = selection.value.mission === name;
  const element = useRef(/** @type {HTMLLIElement | null} */ (null));
  useEffect(() => { if (isOpen) element.current?.scrollIntoView({ block: "nearest" }); }, [isOpen]);
  const texts = fields.mission.filter(({ own, type }) => own && type === "text")
    .map(({ name: key }) => row.fields[key]).filter(Boolean);
  const facts = [
    progress(row), retries && row.attempt > 1 && t("monitor.attempt", { n: row.attempt }),
    rounds && t("monitor.round", { n: row.round + 1 }),
  ].filter(Boolean).join(" · ");
  return h("li", { ref: element, class: `mission-entry ${isOpen ? "open" : ""}`, "data-mission": name },
    h("button", {
      type: "button", class: "opener", "aria-expanded": isOpen,
      onClick: () => selectMission(isOpen ? null : name),
    },
    h("span", { class: `token ${toneOf(row.status)}` }, row.index + 1),
    h("span", { class: "opener-words" },
      h("strong", { class: "called" }, name), texts.length > 0 && h("small", null, texts.join(" · ")),
      h("small", { class: "num" }, facts)),
    h("span", { class: "opener-end" }, h(Standing, { status: row.status }), h(Due, { world, row }))),
    h("div", { class: "track", "aria-hidden": true },
      h("span", { style: { width: `${row.total ? (100 * row.done) / row.total : 0}%` } })),
    h("div", { class: "mission-more" }, row.drone && h(Carrier, { world, id: row.drone }), h(Because, { world, row })),
    isOpen && h(Details, { world, row, live }));
}

/** @param {{ world: World, row: MissionRow }} props */
function Due({ world, row }) {
  if (row.due === null && !row.late) return null;
  return h(Chip, { kind: row.late ? "bad" : "" }, due(row, world.state.value.time));
}

/** @param {{ world: World, row: MissionRow }} props */
function Because({ world, row }) {
  const now = row.until === null ? 0 : world.state.value.time;
  const { text, isOwn } = why(row, now);
  return text ? h(Said, { class: "because", text, isOwn }) : null;
}

/** @param {{ world: World, id: string }} props */
function Carrier({ world, id }) {
  return h("span", { class: "carrier" },
    h("button", { type: "button", class: "link", onClick: () => selectDrone(id) }, id),
    h(Battery, { level: world.drones.get(id)?.battery ?? null }));
}

/** @param {FieldShape} field @param {MissionRow} row */
function filled({ name, label, default: usual, units }, row) {
  const value = row.fields[name] ?? usual;
  if (value === undefined || value === null || value === "") return null;
  const said = typeof value === "boolean" ? t(value ? "yes" : "no") : inWords(value, units);
  return `${label ?? capital(name)}: ${said}`;
}

const HEIGHT = 80; // pixels of a trip in the list, about

/** @param {{ world: World, row: MissionRow, live: boolean }} props */
function Details({ world, row, live }) {
  const { fields } = /** @type {AppShape} */ (app.value);
  const list = useRef(/** @type {HTMLOListElement | null} */ (null));
  const parts = useLongList(list, row.trips.length);
  const { phase } = world.state.value;
  const can = live && mayFly.value;
  const isOver = hasEnded(row) || phase !== "flying";
  const own = fields.mission.filter((field) => field.own).map((field) => filled(field, row)).filter(Boolean);
  const drawn = plan.missions.value.find((mission) => mission.name === row.name);
  const send = (/** @type {string} */ name, more = {}) => { perform(name, { mission: row.name, ...more }); };
  return h("div", { class: "details" },
    own.length > 0 && h("p", { class: "hint" }, own.join(" · ")),
    h("ol", { ref: list, class: "trip-lines" }, parts.map(({ at, gap }) => (gap ? h(Gap, { key: `gap ${at}`, at, gap, height: HEIGHT }) : h(Trip, {
      key: `${row.trips[at].name} ${at}`, trip: row.trips[at], index: at, isCurrent: at === row.current && !hasEnded(row), count: row.trips.length,
      can: can && !isOver, send, hasPriority: fields.trip.some(({ name }) => name === "priority"),
    })))),
    can && h("div", { class: "row" },
      !isOver && row.question === null && h(Button, {
        small: true, onClick: () => send(row.status === "PAUSED" ? "go-on" : "pause"),
      }, t(row.status === "PAUSED" ? "answer.go-on" : "monitor.pause")),
      !isOver && h(SureButton, {
        label: t("monitor.cancel"), sure: t("monitor.cancel-sure"), onSure: () => send("cancel"),
      }),
      phase === "over" && drawn && h(Button, { small: true, onClick: () => { start([drawn.key]); } },
        t("monitor.start-again"))));
}

/** @param {{ trip: TripRow, index: number, count: number, isCurrent: boolean, can: boolean, hasPriority: boolean, send: (name: string, more?: object) => void }} props */
function Trip({ trip, index, count, isCurrent, can, hasPriority, send }) {
  const name = calledTrip(trip, index);
  const isOpen = can && trip.status !== "COMPLETED" && trip.status !== "SKIPPED";
  const priority = trip.priority ?? 1;
  const prioritise = (/** @type {number} */ by) => send("prioritise", { trip: trip.name, priority: priority + by });
  return h("li", { "aria-current": isCurrent ? "step" : undefined, "data-at": index, "aria-posinset": index + 1, "aria-setsize": count },
    h("span", { class: "nth num" }, `${index + 1}.`),
    h("span", { class: "trip-words" }, h("span", { class: "called" }, name), h("small", null, done(trip))),
    h(Standing, { status: trip.status }),
    isOpen && h("span", { class: "row" },
      hasPriority && trip.priority !== null && h("span", { class: "weighs" },
        h(IconButton, { icon: "minus", label: t("monitor.lower", { trip: name }), onClick: () => prioritise(-1) }),
        h("span", { class: "num", title: t("monitor.priority") }, number(priority)),
        h(IconButton, { icon: "plus", label: t("monitor.raise", { trip: name }), onClick: () => prioritise(1) })),
      h("button", {
        type: "button", class: "button quiet small", "aria-label": t("monitor.skip-trip", { trip: name }),
        onClick: () => send("skip", { trip: trip.name }),
      }, t("monitor.skip"))));
}
