// A field of an app, with its label, and what is wrong with it; and what is typed into it as a value of the plan, and
// back. What is typed stays as long as one types; what another page writes meanwhile is told.

import { h } from "preact";
import { useId, useRef, useState } from "preact/hooks";
import { capital, inWords, t, TIME, typedNumber, typedQuantity, usualUnit } from "../core/i18n.js";
import { Check, Input, Problem, Select } from "./parts.js";

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

/** @typedef {FieldProps & { id: string, text: string }} ControlProps text: what is wrong */

/** @param {FieldProps} props */
export function Field(props) {
  const { type, needed } = props.field;
  const id = useId();
  const given = { ...props, id, text: props.problem ?? "" };
  if (type === "rounds") return framed(given, Rounds(given));
  if (type === "bool") return framed(given, needed ? YesOrNo(given) : Tick(given));
  if (type === "evaluator") return framed(given, Evaluator(given));
  if (type === "along") return framed(given, Along(given));
  return h(Typed, given);
}

/** A control with its label, and what is wrong with it. @param {ControlProps} props @param {ComponentChildren} control */
const framed = ({ field, id, text, isOwn }, control) => h("div", { class: "field", "data-field": field.name },
  h("label", { for: id }, field.label ?? capital(field.name)), control,
  h(Problem, { id: `${id}-problem`, hidden: !text, "aria-live": "polite", text, isOwn }));

/** What all controls have. @param {ControlProps} props */
const shared = ({ id, text, isWrong, field, locked }) => ({
  id, disabled: locked, "aria-describedby": `${id}-problem`,
  "aria-invalid": text || isWrong ? "true" : undefined, "aria-required": field.needed ? "true" : undefined,
});

/** @param {ControlProps} props */
function Typed(props) {
  const { field, value, hint, wrong, isLazy, onChange, onKeyDown } = props;
  /** What stands in the field while one types, and what that was sent as. */
  const [typed, setTyped] = useState(/** @type {string | null} */ (null));
  const sent = useRef("");
  const now = String(value ?? "");
  const isForeign = typed !== null && sent.current !== now;
  const text = isForeign ? `${t("field.foreign", { now })} ${props.text}` : props.text;

  /** @param {HTMLInputElement} input @param {boolean} typing */
  function send(input, typing) {
    const fresh = read(field, input.value);
    const why = input.validity.badInput ? t("field.half-a-time") : wrong?.(fresh) ?? "";
    if (!typing && isForeign && String(fresh ?? "") === sent.current) return; // it is left: theirs stays
    sent.current = why ? input.value : String(fresh ?? "");
    onChange(why ? undefined : fresh, typing, why ? { typed: input.value, why } : null);
  }
  const all = { ...props, text, isOwn: isForeign || props.isOwn };
  return framed(all, h("input", {
    ...shared(all), type: field.type === "time of day" ? "time" : "text", maxLength: 500,
    autocomplete: "off", spellcheck: false, inputMode: isNumeric(field) ? "decimal" : undefined,
    placeholder: hint || placeholder(field) || undefined, value: typed ?? written(field, value), onKeyDown,
    onInput: (/** @type {InputEvent} */ { currentTarget }) => {
      const input = /** @type {HTMLInputElement} */ (currentTarget);
      setTyped(input.value);
      if (isLazy) sent.current = now;
      else send(input, true);
    },
    onChange: (/** @type {Event} */ { currentTarget }) => {
      send(/** @type {HTMLInputElement} */ (currentTarget), false);
      setTyped(null);
    },
    onBlur: (/** @type {FocusEvent} */ { currentTarget }) => {
      const input = /** @type {HTMLInputElement} */ (currentTarget);
      if (input.validity.badInput) send(input, false); // browsers do not call that a change
      setTyped(null);
    },
  }));
}

/** @param {ControlProps} props */
function Rounds(props) {
  const { value, locked, onChange } = props;
  const isEndless = value === true;
  const change = (/** @type {Event} */ event, /** @type {boolean} */ typing) => {
    const { value: text } = /** @type {HTMLInputElement} */ (event.currentTarget);
    onChange(read({ name: "", type: "int" }, text), typing, null);
  };
  return h("div", { class: "row rounds" },
    h("input", {
      ...shared(props), inputMode: "numeric", placeholder: "0", maxLength: 20, autocomplete: "off",
      disabled: locked || isEndless, value: isEndless ? "" : String(value ?? ""),
      onInput: (/** @type {Event} */ event) => change(event, true),
      onChange: (/** @type {Event} */ event) => change(event, false),
    }),
    h("span", { class: "hint" }, t("field.more-rounds")),
    h(Check, { disabled: locked, checked: isEndless, onTick: (yes) => onChange(yes || undefined, false, null) }, t("field.until-stopped")));
}

/** @param {ControlProps} props */
function YesOrNo(props) {
  const now = props.value === undefined ? "" : props.value ? "yes" : "no";
  return h(Select, {
    ...shared(props), class: "", value: now, options: [["", t("choose")], ["yes", t("yes")], ["no", t("no")]],
    onPick: (picked) => props.onChange(picked ? picked === "yes" : undefined, false, null),
  });
}

/** @param {ControlProps} props */
function Tick(props) {
  const { field, value, onChange } = props;
  const isTicked = Boolean(value ?? field.default ?? false);
  return h("input", {
    ...shared(props), type: "checkbox", checked: isTicked, onChange: () => onChange(!isTicked, false, null),
  });
}

const USUALLY_EVERY = "1 m";

/** What is done on the way, and how often. @param {ControlProps} props */
function Along(props) {
  const { field: { actions = [], spaced = [] }, locked, onChange } = props;
  const now = /** @type {Along} */ (typeof props.value === "string" ? { action: props.value } : props.value ?? { action: "" });
  const { action, every } = now;
  const pick = (/** @type {string} */ name) =>
    (name ? { action: name, ...(spaced.includes(name) ? { every: every ?? USUALLY_EVERY } : {}) } : undefined);
  return h("div", { class: "row along" },
    h(Select, { ...shared(props), class: "", value: action, options: [["", t("none")], ...actions.map((name) => [name, capital(name)])], onPick: (name) => onChange(pick(name), false, null) }),
    spaced.includes(action) && h(Input, {
      class: "", "aria-label": t("field.every"), placeholder: t("field.such-as", { example: "2 m" }), maxLength: 20, autocomplete: "off", disabled: locked, value: every ?? "",
      onText: (text) => onChange({ ...now, every: text }, true, null), // and no onChange: that comes, too, as it is taken away
    }));
}

/** @param {ControlProps} props */
function Evaluator(props) {
  const own = (props.evaluators ?? []).map((name) => [name, capital(name)]);
  return h(Select, {
    ...shared(props), class: "", value: String(props.value ?? ""), options: [["", t("field.own-evaluator")], ...own],
    onPick: (picked) => props.onChange(picked || undefined, false, null),
  });
}
