// Who else looks at the station, and what they have selected: a dot with a letter, and their names.

import { h } from "preact";
import { t } from "../core/i18n.js";
import { world } from "../core/station.js";

const COLOURS = 6; // that tokens.css has

/** @param {Person} person */
const nameOf = ({ name }) => name.trim() || t("people.unnamed");

/** The same colour for the same person, on every page. @param {Person} person */
function colourOf({ id }) {
  const sum = [...id].reduce((all, letter) => (all * 31 + letter.charCodeAt(0)) % 65521, 7);
  return `var(--person-${(sum % COLOURS) + 1})`;
}

/** @param {{ person: Person }} props */
const Dot = ({ person }) => h("span", {
  class: "person", style: { background: colourOf(person) }, title: nameOf(person), "aria-hidden": true,
}, nameOf(person)[0].toUpperCase());

/** How many others are here, with their names. */
export function Others() {
  const people = world.people.value;
  if (!people.length) return null;
  const said = t("people.others", { n: people.length, names: people.map(nameOf) });
  return h("span", { class: "people", role: "img", "aria-label": said, title: said },
    people.slice(0, 4).map((person) => h(Dot, { key: person.id, person })),
    people.length > 4 && h("span", { class: "num muted", "aria-hidden": true }, `+${people.length - 4}`));
}

/** Those who have one of these selected: a mission, or its trips. @param {{ keys: readonly string[] }} props */
export function Touching({ keys }) {
  const people = world.people.value.filter(({ touches }) => keys.includes(touches));
  if (!people.length) return null;
  const said = t("people.touch", { n: people.length, names: people.map(nameOf) });
  return h("span", { class: "people", role: "img", "aria-label": said, title: said },
    people.slice(0, 3).map((person) => h(Dot, { key: person.id, person })));
}
