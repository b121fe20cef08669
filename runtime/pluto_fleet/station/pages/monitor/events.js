// What has happened, the newest first: where, what it was about, and which missions were made of it, or why none was.

import { signal } from "@preact/signals";
import { h } from "preact";
import { useState } from "preact/hooks";
import { command, ofStation } from "../core/api.js";
import { capital, clock, inWords, number, plain, t } from "../core/i18n.js";
import { app, mayFly, selectMission, tell } from "../core/station.js";
import { prefs } from "../core/prefs.js";
import { called } from "../map/tracked.js";
import { Field } from "../ui/field.js";
import { Button, Empty, joined, Problem, Said, Select } from "../ui/parts.js";

/** Whether anything came of it: an app that declares no events may still react to what is built in. @param {EventRow} row */
export const mattered = ({ over, broke_off: broken }) => over !== null || broken.length > 0;

const SHOWN = 100;
const RAISED_IN = ["flying", "stopped", "interrupted"]; // what is stopped hears of it when it goes on

/** @param {{ world: World, live: boolean }} props */
export function EventList({ world, live }) {
  const rows = world.events.all().slice(-SHOWN).reverse();
  const types = /** @type {AppShape} */ (app.value).events;
  const canRaise = live && mayFly.value && types.length > 0 && RAISED_IN.includes(world.state.value.phase);
  return h("div", null, canRaise && h(Raise, { world, types }),
    rows.length ? h("ul", { "aria-label": t("monitor.events") }, rows.map((row) => h(Happened, { key: row.id, row })))
      : h(Empty, null, t("event.none")));
}

/** @param {{ name: string }} props */
const MissionLink = ({ name }) => h("button", {
  type: "button", class: "link",
  onClick: () => {
    selectMission(name);
    prefs.railTab.value = "missions";
  },
}, name);

/** @param {{ row: EventRow }} props */
function Happened({ row: { id, name, time, at, track, mission, drone, fields, made, broke_off: broken, why, over } }) {
  const facts = [
    at && t("event.at", { x: number(at[0]), y: number(at[1]) }), track && t("event.track", { track }),
    ...Object.entries(fields).filter(([, value]) => value !== null).map(([field, value]) => `${plain(field)}: ${inWords(/** @type {Scalar} */ (value))}`),
    mission && h(MissionLink, { name: mission }), drone,
  ].filter(Boolean);
  const isAsked = over === null && app.value?.events.find((one) => one.name === name)?.creates;
  return h("li", { class: "event-entry", "data-event": id },
    h("p", { class: "row" }, h("span", { class: "muted num" }, clock(time)), h("strong", { class: "called" }, capital(name)), h("small", { class: "called" }, id)),
    facts.length > 0 && h("p", { class: "because" }, joined(facts)),
    made.length > 0 && h("p", null, t("event.made"), " ", joined(made.map((one) => h(MissionLink, { name: one })))),
    broken.length > 0 && h("p", null, t("event.broke-off"), " ", joined(broken.map((one) => h(MissionLink, { name: one })))),
    !made.length && (why || !broken.length) && h("p", { class: "because" }, why ? h(Said, { text: why }) : t(isAsked ? "event.open" : "event.nobody")));
}

/** What the next press on the map is taken for; null: for nothing. */
export const picking = signal(/** @type {((at: At) => void) | null} */ (null));

/** @param {string} name @param {string} label @returns {FieldShape} */
const metres = (name, label) => ({ name, type: "float", label, hint: t("event.optional") });
const WHERE = ["x", "y"];

/** A person raises an event. @param {{ world: World, types: readonly EventShape[] }} props */
function Raise({ world, types }) {
  const [name, setName] = useState(types[0].name);
  const [given, give] = useState(/** @type {Record<string, any>} */ ({}));
  const [track, follow] = useState("");
  const [problem, setProblem] = useState({ of: "", text: "", isOwn: false });
  const type = types.find((one) => one.name === name) ?? types[0];
  const tracks = world.tracks.all();
  const about = tracks.find(({ id }) => id === track);

  /** @param {SubmitEvent} event */
  async function submit(event) {
    event.preventDefault();
    const at = WHERE.map((axis) => given[axis]);
    const isPlaced = at.some((one) => one !== undefined);
    const half = WHERE.find((_, axis) => isPlaced && typeof at[axis] !== "number");
    if (half) {
      setProblem({ of: half, text: t("event.write-metres"), isOwn: true });
      return;
    }
    const fields = Object.fromEntries(type.fields.map((field) => [field.name, given[field.name]]).filter(([, value]) => value !== undefined));
    const place = isPlaced ? { at } : about ? { at: [about.x, about.y] } : {};
    try {
      tell(await command(`events/${name}`, { fields, ...place, ...(track ? { track } : {}) }), { isSaid: true, settles: true });
      setProblem({ of: "", text: "", isOwn: false });
      give({});
    } catch (error) {
      const { message, isSaid } = ofStation(error);
      const [, of = ""] = /^event \S+: (\w+) /.exec(message) ?? [];
      setProblem({ of: of === "at" ? "x" : of, text: message, isOwn: !isSaid });
    }
  }
  /** @param {FieldShape} field */
  const input = (field) => h(Field, {
    key: `${name} ${field.name}`, field: { ...field, own: true }, value: given[field.name],
    problem: problem.of === field.name ? problem.text : "", isOwn: problem.isOwn,
    onChange: (value) => give((before) => ({ ...before, [field.name]: value })),
  });
  const all = [...type.fields, metres("x", t("event.x")), metres("y", t("event.y"))];
  const isElsewhere = problem.text && !all.some((field) => field.name === problem.of);
  const pick = () => {
    picking.value = picking.peek() ? null : ({ x, y }) => {
      give((before) => ({ ...before, x: Number(x.toFixed(2)), y: Number(y.toFixed(2)) }));
      picking.value = null;
    };
  };
  return h("details", { class: "join", onToggle: () => { picking.value = null; } }, h("summary", null, t("event.raise-title")),
    h("form", { class: "stack", onSubmit: submit },
      h("div", { class: "fields" },
        h("div", { class: "field" }, h("label", { for: "event-name" }, t("event.which")),
          h(Select, { class: "", id: "event-name", value: name, options: types.map((one) => [one.name, capital(one.name)]), onPick: setName })),
        tracks.length > 0 && h("div", { class: "field" }, h("label", { for: "event-track" }, t("event.about")),
          h(Select, {
            class: "", id: "event-track", value: track, onPick: follow,
            options: [["", t("none")], ...tracks.map((row) => [row.id, called(row, row.seen)])],
          })),
        all.map(input)),
      isElsewhere && h(Problem, { role: "alert", text: problem.text, isOwn: problem.isOwn }),
      h("div", { class: "row" },
        h(Button, { small: true, icon: "pin", pressed: picking.value !== null, onClick: pick }, t(picking.value ? "event.pick-now" : "event.pick")),
        h(Button, { type: "submit", small: true, kind: "primary" }, t("event.raise")))));
}
