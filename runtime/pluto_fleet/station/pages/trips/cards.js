// The trips of the selected mission in their order: each a card, of which one is open.

import { h } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { capital, t } from "../core/i18n.js";
import { useSortable } from "../ui/hooks.js";
import { ActionIcon, Button, Chip, Icon } from "../ui/parts.js";
import { Touching } from "../ui/people.js";
import { TripCard } from "./card.js";
import { copy, meant, move, remove, shift, where } from "./commands.js";
import { abouts, extendTo, isLocked, marked, markOne, toggle } from "./state.js";

/** @import { About } from "./state.js" */

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

export function TripCards() {
  const all = abouts.value;
  const keys = all.map(({ key }) => key);
  const { order, dragged, hands } = useSortable(keys, move, isLocked.value);
  const by = new Map(all.map((about) => [about.key, about]));
  return h("ol", { ...hands, class: "trip-cards", "aria-label": t("trips.list") }, order.map((key) => h(Card, {
    key, about: /** @type {About} */ (by.get(key)), isDragged: key === dragged,
    isChosen: marked.value.includes(key), isOpen: marked.value.length === 1 && marked.value[0] === key,
  })));
}

/** @param {{ about: About, isDragged: boolean, isChosen: boolean, isOpen: boolean }} props */
function Card({ about, isDragged, isChosen, isOpen }) {
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
