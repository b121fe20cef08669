// The fields of a trip: where it goes, what it carries, its parameters, and what the app adds.

import { h } from "preact";
import { capital, t } from "../core/i18n.js";
import { app, selected } from "../core/station.js";
import { ownFirst } from "../missions/words.js";
import { Field } from "../ui/field.js";
import { Button, Icon, Said } from "../ui/parts.js";
import { RELEASE } from "./carried.js";
import { copy, remove, setAxis, setDraft, setField, setIn, shift } from "./commands.js";
import { abouts } from "./state.js";

/** @import { Changed } from "../ui/field.js" */
/** @import { About } from "./state.js" */

/** @typedef {{ field: FieldShape, value: (trip: PlanTrip, about: About) => unknown, onChange: Changed, wrong?: (value: unknown) => string }} Slot */

/** @type {FieldShape} */
const MASS = { name: "mass", type: "mass", units: ["g", "mg", "kg"] };
const AXES = /** @type {const} */ (["x", "y", "z"]);

/** Everything that is filled in of a trip, in its order. @param {string} key @param {ActionShape | undefined} action @param {string} name of the action @param {AppShape} shape @returns {Slot[]} */
function slots(key, action, name, { map, fields }) {
  const label = (/** @type {FieldShape} */ field) => field.label ?? capital(field.name);
  /** @type {(axis: 0 | 1 | 2) => Slot} */
  const axisSlot = (axis) => {
    const usual = axis === 2 ? map.cruise_height : null;
    const value = (/** @type {any} */ trip) => trip.target?.[axis];
    return {
      field: { name: AXES[axis], label: t(`trips.${AXES[axis]}`), type: "float", default: usual },
      value: (_, { target }) => target?.[axis],
      wrong: (typed) => (typeof typed === "number" || (axis === 2 && typed === undefined) ? "" : t("trips.write-metres")),
      onChange: (typed, typing, wrong) => {
        setDraft(key, AXES[axis], wrong && { ...wrong, now: (trip) => value(trip) ?? usual });
        if (!wrong) setAxis(key, axis, /** @type {number | undefined} */ (typed), typing);
      },
    };
  };
  /** @type {(part: "item" | "parameters", field: FieldShape, inside: string) => Slot} */
  const inPart = (part, field, inside) => ({
    field: { ...field, name: `${part}.${inside}`, label: label(field) },
    value: (trip) => /** @type {Record<string, unknown> | null} */ (trip[part])?.[inside],
    onChange: (value, typing) => setIn(key, part, inside, value, typing),
  });
  /** @type {(field: FieldShape) => Slot} */
  const own = (field) => ({
    field, value: (trip) => trip[field.name],
    onChange: (value, typing) => setField(key, field.name, value, typing),
  });
  return [
    axisSlot(0), axisSlot(1), axisSlot(2), own({ name: "name", type: "text", label: t("name") }),
    ...(action?.item && name !== RELEASE
      ? [inPart("item", { name: "name", type: "text", label: t("trips.item") }, "name"), inPart("item", { ...MASS, label: t("trips.mass") }, "mass")] : []),
    ...(action?.parameters ?? []).map((field) => inPart("parameters", field, field.name)),
    ...ownFirst(fields.trip).map(own),
  ];
}

/** @param {{ about: About, onRemoved: (next: string | null) => void }} props */
export function TripCard({ about, onRemoved }) {
  const { key, trip, number, problems, pickedIn } = about;
  const shape = /** @type {AppShape} */ (app.value);
  const action = shape.actions.find(({ name }) => name === trip.action);
  const all = slots(key, action, trip.action, shape);
  const known = all.map(({ field }) => field.name);
  const locked = about.isFixed;
  const isMisplaced = problems.some(({ field }) => field === "target");
  const elsewhere = problems.filter(({ field }) => !known.includes(field ?? ""));
  const mass = trip.item?.mass === undefined ? "" : ` (${trip.item.mass})`;
  return h("div", { class: "trip-body" },
    elsewhere.length > 0 && h("div", { class: "wide" }, elsewhere.map(({ text, isOwn }) => h("p", { key: text, class: "problem" },
      h(Icon, { name: "warning" }), h(Said, { text, isOwn })))),
    trip.action === RELEASE && h("p", { class: "wide hint" }, pickedIn
      ? t("trips.puts-down", { item: `${trip.item?.name ?? ""}`, mass, n: pickedIn }) : t("trips.put-pick-before")),
    all.map(({ field, value, onChange, wrong }) => {
      const own = problems.filter((one) => one.field === field.name);
      return h(Field, {
        key: field.name, field, value: own[0]?.typed ?? value(trip, about), locked, onChange, wrong,
        problem: own.map(({ text }) => text).join(" "), isOwn: own.every(({ isOwn }) => isOwn), evaluators: shape.evaluators,
        isLazy: selected.value?.launched === true, // letter by letter is no way to steer a flight
        isWrong: isMisplaced && (field.name === "x" || field.name === "y"),
        hint: field.name === "name" ? String(number) : "",
      });
    }),
    !locked && h("div", { class: "row wide" },
      h(Button, { small: true, disabled: number === 1, onClick: () => shift(key, -1) }, t("trips.earlier")),
      h(Button, { small: true, disabled: number === abouts.value.length, onClick: () => shift(key, 1) }, t("trips.later")),
      h(Button, { small: true, onClick: () => copy([key]) }, t("copy")),
      h(Button, { small: true, onClick: () => onRemoved(remove([key])) }, t("delete"))));
}
