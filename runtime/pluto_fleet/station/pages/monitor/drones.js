// The drones as a list, and the card of the selected one: how it is, why, and what can be done with it; and one
// more that joins the flight.

import { h } from "preact";
import { useRef, useState } from "preact/hooks";
import { duration, many, number, roughly, t, typedNumber } from "../core/i18n.js";
import { app, line, mayFly, perform, selectDrone, selection, selectMission } from "../core/station.js";
import { followed } from "../map/tracked.js";
import {
  Battery, Button, Empty, Icon, IconButton, joined, Said, Select, Standing, toneOf, walking,
} from "../ui/parts.js";

const END = 0.95; // of the way

/**
 * @param {{ label: string, onEnd: () => void, disabled?: boolean }} props
 * By keyboard and screen reader it is a slider: the right arrow, pressed to its end, acts.
 */
export function Slide({ label, onEnd, disabled }) {
  const [at, setAt] = useState(0);
  const track = useRef(/** @type {HTMLDivElement | null} */ (null));
  const from = useRef(/** @type {number | null} */ (null));

  /** @param {number} value */
  function move(value) {
    const next = Math.min(1, Math.max(0, value));
    if (next < END) {
      setAt(next);
      return;
    }
    from.current = null;
    setAt(0);
    onEnd();
  }
  const width = () => Math.max(1, (track.current?.clientWidth ?? 0) - 44);
  const letGo = () => {
    from.current = null;
    setAt(0);
  };
  return h("div", { class: "slide", ref: track, style: { "--at": at } },
    h("span", { class: "slide-label", "aria-hidden": true }, label),
    h("button", {
      type: "button", class: "slide-thumb", role: "slider", disabled, "aria-label": label,
      "aria-valuemin": 0, "aria-valuemax": 100, "aria-valuenow": Math.round(at * 100),
      onPointerDown: (/** @type {PointerEvent} */ event) => {
        /** @type {HTMLElement} */ (event.currentTarget).setPointerCapture(event.pointerId);
        from.current = event.clientX;
      },
      onPointerMove: (/** @type {PointerEvent} */ event) => {
        if (from.current !== null) move((event.clientX - from.current) / width());
      },
      onPointerUp: letGo, onPointerCancel: letGo, onBlur: letGo,
      onKeyDown: (/** @type {KeyboardEvent} */ event) => {
        if (event.key === "ArrowRight" && !event.repeat) move(at + 0.2);
        else if (event.key === "ArrowLeft") move(at - 0.2);
        else return;
        event.preventDefault();
      },
    }, h(Icon, { name: "speed" })));
}

const IN_THE_AIR = 0.2; // metres: below, a drone may stand on something

const STANDS_OUT = ["LOST", "UNKNOWN", "ALOFT"]; // what a person must know, though it is retired

const MISHAPS = /** @type {const} */ (["lost", "crash", "battery", "uncertain"]);

/** @param {DroneRow} row */
const statusOf = ({ status, retired }) => (retired && !STANDS_OUT.includes(status) ? "RETIRED" : status);

/** How old what is known is, and where it was then; a drone that is heard of now does not follow the clock. @param {DroneRow} row */
function seen({ seen_at: at, x, y }) {
  if (at === null || x === null || y === null) return "";
  const ago = Math.max(0, line.clock.value - Math.floor(at / 1000));
  return t("drone.seen", { x: number(x), y: number(y), time: roughly(ago) });
}

/** @param {{ world: World, live: boolean }} props */
export function DroneList({ world, live }) {
  const ids = world.drones.keys.value;
  if (!ids.length) return h(Empty, null, t("monitor.no-drones"));
  const canJoin = live && mayFly.value && world.state.value.phase === "flying";
  return h("div", null, canJoin && h(Join, null), h("ul", { class: "drone-rows", "aria-label": t("monitor.drones"), onKeyDown: walking(".opener") },
    ids.map((id) => h(DroneLine, { key: id, world, id, live }))));
}

/** @param {{ world: World, id: string, live: boolean }} props */
function DroneLine({ world, id, live }) {
  const row = /** @type {DroneRow} */ (world.drones.get(id));
  const isChosen = selection.value.drone === id;
  return h("li", { class: `drone-entry ${isChosen ? "open" : ""}`, "data-drone": id },
    h("button", { type: "button", class: "opener", "aria-pressed": isChosen, onClick: () => selectDrone(isChosen ? null : id) },
      h("span", { class: `dot ${toneOf(statusOf(row))}`, "aria-hidden": true }),
      h("span", { class: "opener-words" }, h("strong", { class: "called" }, id),
        row.mission && h("small", null, row.mission)),
      h("span", { class: "opener-end" }, h(Standing, { status: statusOf(row) }), h(Battery, { level: row.battery }))),
    h(WhyNot, { row, live }));
}

/** @param {{ row: DroneRow, live: boolean }} props */
function WhyNot({ row, live }) {
  const facts = [
    row.why && h(Said, { text: row.why }), live ? seen(row) : "",
    row.ready_in ? t("drone.ready-in", { time: duration(row.ready_in) }) : "",
  ].filter(Boolean);
  return facts.length ? h("p", { class: "because" }, joined(facts)) : null;
}

/** The card of a drone, on the map. @param {{ world: World, id: string, live: boolean }} props */
export function DroneCard({ world, id, live }) {
  const row = world.drones.get(id);
  if (!row) return null;
  const { categories, drones, sim } = /** @type {AppShape} */ (app.value);
  const category = categories.length > 1 ? drones.find((one) => one.id === id)?.category : undefined;
  const can = live && mayFly.value;
  const isAway = row.retired || row.status === "LOST";
  const flies = (row.z ?? 0) > IN_THE_AIR;
  const track = followed(world, row);
  const isRunning = world.state.value.phase === "flying";
  return h("section", { class: "drone-card card stack", "aria-label": t("drone.card", { drone: id }) },
    h("div", { class: "row" }, h("h2", { class: "called" }, id), category && h("span", { class: "muted" }, category),
      h("span", { class: "spread" }, h(IconButton, { icon: "close", label: t("close"), onClick: () => selectDrone(null) }))),
    h("div", { class: "row" }, h(Standing, { status: statusOf(row) }), h(Battery, { level: row.battery }),
      h("span", { class: "muted num" }, many("many.trips", row.trips))),
    h(WhyNot, { row, live }),
    row.mission && h("p", null, t("drone.mission"), " ",
      h("button", { type: "button", class: "link", onClick: () => selectMission(row.mission) }, row.mission)),
    track && h("p", null, t("drone.follows", { track })),
    row.x !== null && row.y !== null && row.seen_at === null && h("p", { class: "muted num" },
      t("drone.at", { x: number(row.x), y: number(row.y), z: number(row.z ?? 0) })),
    can && h("div", { class: "row" },
      (isAway || isRunning) && h(Button, {
        small: true, onClick: () => { perform(isAway ? "bring-back" : "retire", { drone: id }); },
      }, t(isAway ? "drone.bring-back" : "drone.retire"))),
    can && flies && h(CutMotors, { id }),
    can && sim && isRunning && h(Mishaps, { id }));
}

/** The motors off at once: by a slide, or by a word that is typed, for screen readers and voices. @param {{ id: string }} props */
function CutMotors({ id }) {
  const [isTyping, type] = useState(false);
  const field = useRef(/** @type {HTMLInputElement | null} */ (null));
  const cut = () => { perform("cut-motors", { drone: id }); };
  /** @param {SubmitEvent} event */
  function submit(event) {
    event.preventDefault();
    const isRight = field.current?.value.trim().toLowerCase() === t("drone.cut-word");
    if (field.current) field.current.value = "";
    if (!isRight) return;
    type(false);
    cut();
  }
  return h("div", { class: "stack" },
    h(Slide, { label: t("drone.cut", { drone: id }), onEnd: cut }),
    isTyping
      ? h("form", { class: "field", onSubmit: submit },
        h("label", { for: "cut-word" }, t("drone.cut-how", { word: t("drone.cut-word") })),
        h("input", { id: "cut-word", ref: field, autocomplete: "off" }))
      : h("button", { type: "button", class: "link", onClick: () => type(true) }, t("drone.cut-type")));
}

/** Mishaps of a simulated drone, to rehearse what people do then. @param {{ id: string }} props */
const Mishaps = ({ id }) => h("details", { class: "mishaps" },
  h("summary", null, t("mishap.title")),
  h("p", { class: "hint" }, t("mishap.hint")),
  h("div", { class: "row" }, MISHAPS.map((kind) => h(Button, {
    key: kind, small: true, onClick: () => { perform("mishap", { drone: id, kind }); },
  }, t(`mishap.${kind}`)))));

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
          h(Select, { class: "", id: "join-category", name: "category", options: categories.map(({ name }) => [name, name]) })),
        field("x", t("join.x")), field("y", t("join.y")), !sim && field("uri", t("join.uri"), false)),
      h("div", null, h(Button, { type: "submit", small: true }, t("join.add")))));
}
