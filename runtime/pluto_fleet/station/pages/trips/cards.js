// The trips of the selected mission in their order: each a card, of which one is open, with its fields: where it
// goes, what it carries, its parameters, and what the app adds.

import { h } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { capital, t } from "../core/i18n.js";
import { app, selected } from "../core/station.js";
import { ownFirst } from "../missions/words.js";
import { Field } from "../ui/field.js";
import { useSortable } from "../ui/hooks.js";
import { Gap, useLongList } from "../ui/long_list.js";
import { ActionIcon, Button, Chip, Icon, Said } from "../ui/parts.js";
import { Touching } from "../ui/people.js";
import { RELEASE } from "./carried.js";
import { copy, meant, move, remove, setAxis, setDraft, setField, setIn, shift, where } from "./commands.js";
import { abouts, extendTo, isLocked, marked, markOne, toggle } from "./state.js";

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

/** Focus the head of a trip's card, when it is drawn. @param {string | null} key */
export function focusHead(key) {
  requestAnimationFrame(() =>
    /** @type {HTMLElement | null} */ (document.querySelector(`.trip-card[data-key="${key}"] .trip-head`))?.focus());
}

/** Focus a field of a trip's card, when it is drawn. @param {string} key @param {string} [field] the first one, if it is left out or not there */
export function focusField(key, field = "x") {
  requestAnimationFrame(() => {
    const card = document.querySelector(`.trip-card[data-key="${key}"]`);
    const find = (/** @type {string} */ name) => /** @type {HTMLInputElement | null | undefined} */ (
      card?.querySelector(`[data-field="${name}"] :is(input, select)`));
    const input = find(field) ?? find("x");
    input?.focus();
    if (input instanceof HTMLInputElement && input.type === "text") input.select();
  });
}

const HEIGHT = 50; // pixels of a card that is not drawn, about

export function TripCards() {
  const all = abouts.value;
  const keys = all.map(({ key }) => key);
  const { order, dragged, hands } = useSortable(keys, move, isLocked.value);
  const by = new Map(all.map((about) => [about.key, about]));
  const chosen = new Set(marked.value);
  const [open] = chosen.size === 1 ? chosen : [null];
  const kept = [open, dragged].flatMap((key) => (key && by.has(key) ? [order.indexOf(key)] : []));
  const parts = useLongList(hands.ref, order.length, kept);
  return h("ol", { ...hands, class: "trip-cards", "aria-label": t("trips.list") }, parts.map(({ at, gap }) => {
    if (gap) return h(Gap, { key: `gap ${at}`, at, gap, height: HEIGHT });
    const key = order[at];
    return h(Card, {
      key, about: /** @type {About} */ (by.get(key)), at, count: order.length, isDragged: key === dragged,
      isChosen: chosen.has(key), isOpen: key === open,
    });
  }));
}

/** @param {{ about: About, at: number, count: number, isDragged: boolean, isChosen: boolean, isOpen: boolean }} props at: its place among so many */
function Card({ about, at, count, isDragged, isChosen, isOpen }) {
  const { key, trip, number, target, place, problems } = about;
  const id = useId();
  const element = useRef(/** @type {HTMLLIElement | null} */ (null));
  useEffect(() => { if (isOpen) element.current?.scrollIntoView({ block: "nearest" }); }, [isOpen]);
  /** @param {MouseEvent} event */
  function press(event) {
    if (event.shiftKey) extendTo(key);
    else if (event.ctrlKey || event.metaKey) toggle(key);
    else markOne(isOpen ? null : key);
  }
  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const by = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    const isHead = /** @type {Element} */ (event.target).closest(".trip-head") !== null;
    if (event.altKey && by && !about.isFixed) {
      shift(key, by);
      if (isHead) focusHead(key); // moving it in the list takes the focus away
    } else if (event.key === "Escape" && !isHead) {
      /** @type {HTMLElement | null | undefined} */ (element.current?.querySelector(".trip-head"))?.focus();
    }
    else if (event.key === "Delete" && isHead) focusHead(remove(meant(key)));
    else return;
    event.preventDefault();
  }
  const what = [capital(trip.action), ...(trip.name ? [trip.name] : [])].join(" · ");
  return h("li", {
    ref: element, class: `trip-card ${isChosen ? "chosen" : ""} ${isDragged ? "dragged" : ""}`, "data-key": key, onKeyDown,
    "data-at": at, "aria-posinset": at + 1, "aria-setsize": count,
  },
  h("div", { class: "trip-line" },
    h("span", { class: "grip" }, h(Icon, { name: about.isFixed ? "lock" : "grip" })),
    h("button", { type: "button", class: "trip-head", "aria-expanded": isOpen, "aria-controls": id, onClick: press },
      h("span", { class: "number num" }, number), h(ActionIcon, { action: trip.action }),
      h("span", { class: "what" }, h("span", { class: "called" }, what), " ",
        h("span", { class: "hint" }, target ? place || t("trips.metres", { place: where(target) }) : t("trips.no-place"))),
      problems.length > 0 && h(Chip, { kind: "warn", icon: "warning" }, t("missions.to-mend"))),
    h(Touching, { keys: [key] })),
  h("div", { id }, isOpen && h(TripCard, { about, onRemoved: focusHead })));
}

/** What is done with all pins that are selected. */
export function SeveralTrips() {
  const keys = marked.value;
  if (keys.length < 2) return null;
  return h("div", { class: "several row", role: "group", "aria-label": t("trips.several-group") },
    h("strong", null, t("trips.several", { n: keys.length })),
    !isLocked.value && h(Button, { small: true, onClick: () => copy(keys) }, t("trips.duplicate")),
    !isLocked.value && h(Button, { small: true, onClick: () => focusHead(remove(keys)) }, t("delete")),
    h(Button, { small: true, kind: "quiet", onClick: () => markOne(null) }, t("trips.select-none")));
}
