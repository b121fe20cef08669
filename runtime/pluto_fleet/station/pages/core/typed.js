// What is typed into a field of an app, as a value of the plan, and back. Pure, but for the texts.

import { inWords, t, TIME, typedNumber, typedQuantity, usualUnit } from "./i18n.js";

const NUMERIC = ["int", "float"];

/** @param {FieldShape} field */
const unitsOf = ({ type, units }) => (type === "time" ? TIME : units ?? []);

/** What counts where a field is empty, in words; empty: nothing does. @param {FieldShape} field */
function usually(field) {
  const { type, own, default: usual = null } = field;
  if (usual === null) return "";
  return usual === 0 && type === "time" && !own ? t("none") : inWords(usual, unitsOf(field));
}

/** @param {FieldShape} field */
const unitOf = (field) => usualUnit(unitsOf(field), usually(field));

/** What an empty field shows. @param {FieldShape} field */
export function placeholder(field) {
  const unit = unitOf(field);
  return field.hint || usually(field)
    || (unit && t("field.such-as", { example: field.type === "time" ? "3 min" : `3 ${unit}` }))
    || (field.needed ? t("field.needed") : "");
}

/** A value of the plan, as it is written in its field. @param {FieldShape} field @param {unknown} value */
export const written = (field, value) =>
  (value === undefined || value === null ? "" : inWords(/** @type {Scalar} */ (value), unitsOf(field)));

/** What was typed, as a value of the plan; undefined: nothing. @param {FieldShape} field @param {string} text @returns {Scalar | undefined} */
export function read(field, text) {
  const clean = text.trim();
  if (!clean) return undefined;
  if (NUMERIC.includes(field.type)) return typedNumber(clean);
  return typedQuantity(clean, unitsOf(field), unitOf(field));
}

/** @param {FieldShape} field */
export const isNumeric = ({ type }) => NUMERIC.includes(type);
