// The actions of the app: dragged onto the map, or taken in hand by a press or a digit and put down by
// pressing a place or writing x and y.

import { signal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { capital, t } from "../core/i18n.js";
import { app } from "../core/station.js";
import { ActionIcon, Button } from "../ui/parts.js";
import { add } from "./commands.js";
import { snapped } from "./snapping.js";
import { hovered, inHand, places, tool } from "./state.js";

const SLIP = 6; // pixels
const METRES = "-?\\d+([.,]\\d+)?";

/** The action that is being dragged, and where the pointer is. */
const ghost = signal(/** @type {{ action: ActionShape, x: number, y: number } | null} */ (null));

/** Take an action in hand, or put it back. @param {ActionShape | null} action */
export function take(action) {
  inHand.value = action;
  tool.value = null;
  if (!action) hovered.value = null;
}

/** The new trip's key. @callback Added @param {string} key @param {ActionShape} action @param {string} by the pointer's kind, or `key` */

/** @param {{ camera: Camera, onAdded: Added, onNew: () => void }} props */
export function Palette({ camera, onAdded, onNew }) {
  const { actions = [] } = app.value ?? {};
  const bar = useRef(/** @type {HTMLDivElement | null} */ (null));
  const x = useRef(/** @type {HTMLInputElement | null} */ (null));
  const now = inHand.value;
  /** The named place that was gone to last. */
  const [said, setSaid] = useState("");
  useEffect(() => () => take(null), []);

  /** Take it, and go to where its place is written. @param {ActionShape} action */
  function takeByKey(action) {
    take(action);
    requestAnimationFrame(() => x.current?.focus());
  }
  function back() {
    const at = actions.indexOf(/** @type {ActionShape} */ (inHand.peek()));
    take(null);
    /** @type {HTMLElement | undefined} */ (bar.current?.querySelectorAll("button")[at])?.focus();
  }
  /** @param {SubmitEvent} event */
  function submit(event) {
    event.preventDefault();
    const form = /** @type {HTMLFormElement} */ (event.currentTarget);
    const action = /** @type {ActionShape} */ (inHand.peek());
    const target = ["x", "y"].map((name) => Number(String(new FormData(form).get(name)).replace(",", ".")));
    const [key] = add(action, [{ target }]);
    form.reset();
    setSaid("");
    x.current?.focus(); // for another of the same
    if (key) onAdded(key, action, "key");
  }
  const place = useRef(-1);
  /** The arrow keys go through the named places. @param {KeyboardEvent} event */
  function pickPlace(event) {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const all = places.peek();
    if (!by || !all.length) return;
    event.preventDefault();
    place.current = (place.current + by + all.length) % all.length;
    const { name, x: atX, y: atY } = all[place.current];
    const form = /** @type {HTMLFormElement} */ (event.currentTarget);
    for (const [axis, value] of [["x", atX], ["y", atY]]) {
      /** @type {HTMLInputElement} */ (form.elements.namedItem(String(axis))).value = String(value);
    }
    setSaid(name);
  }
  useEffect(() => { // while no field has the keys, a digit takes the action with that number
    const onKey = (/** @type {KeyboardEvent} */ event) => {
      const target = /** @type {Element} */ (event.target);
      if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input, select, textarea, dialog")) return;
      if (!target.closest(".trips")) return;
      if (event.key === "Escape" && inHand.peek()) back();
      if (event.key.toLowerCase() === "n") onNew();
      const action = event.key.trim() ? actions[Number(event.key) - 1] : undefined;
      if (action) takeByKey(action);
      if (action || event.key.toLowerCase() === "n") event.preventDefault();
    };
    document.addEventListener("keydown", onKey);
    return () => document.removeEventListener("keydown", onKey);
  }, [actions]);
  return h("section", {
    class: "palette", "aria-label": t("trips.actions"),
    onKeyDown: (/** @type {KeyboardEvent} */ { key }) => { if (key === "Escape" && inHand.peek()) back(); },
  },
  h("div", { ref: bar, class: "row", role: "group", "aria-label": t("trips.actions-group") }, actions.map((action, at) =>
    h(Chip, { key: action.name, action, number: at + 1, camera, onAdded, onTake: takeByKey }))),
  now && h("form", { class: "in-hand row", onSubmit: submit, onKeyDown: pickPlace },
    h("span", { class: "hint" }, t("trips.press-or-write", { action: capital(now.name) })),
    ["x", "y"].map((axis) => h("label", { key: axis, class: "row" }, axis, h("input", {
      ref: axis === "x" ? x : undefined, name: axis, class: "input", inputMode: "decimal", required: true, pattern: METRES,
      title: t("trips.write-metres"), "aria-label": axis, autocomplete: "off",
    }))), h("span", null, "m"),
    places.value.length > 0 && h("span", { class: "hint called", "aria-live": "polite" }, said || t("trips.places-by-arrows")),
    h(Button, { kind: "primary", small: true, type: "submit" }, t("trips.add")),
    h(Button, { kind: "quiet", small: true, onClick: back }, t("trips.cancel"))),
  ghost.value && h("div", {
    class: "ghost button", "aria-hidden": true,
    style: { transform: `translate(${ghost.value.x + 12}px, ${ghost.value.y - 56}px)` },
  }, h(ActionIcon, { action: ghost.value.action.name }), capital(ghost.value.action.name)));
}

/** @param {{ action: ActionShape, number: number, camera: Camera, onAdded: Added, onTake: (action: ActionShape) => void }} props */
function Chip({ action, number, camera, onAdded, onTake }) {
  const from = useRef(/** @type {PointerEvent | null} */ (null));
  const wasDragged = useRef(false);
  const isMine = inHand.value === action;

  /** Where it would be put: on the map, and not on what lies over it. @param {PointerEvent} event */
  function target(event) {
    const over = document.elementFromPoint(event.clientX, event.clientY);
    return camera.picture?.contains(over) ? snapped(camera.metres(event), event.shiftKey, places.peek()) : null;
  }
  /** @param {PointerEvent} event */
  function drag(event) {
    const start = from.current;
    if (!start) return;
    if (!ghost.peek() && Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) < SLIP) return;
    if (!ghost.peek()) take(null);
    ghost.value = { action, x: event.clientX, y: event.clientY };
    hovered.value = target(event);
  }
  /** @param {PointerEvent} event @param {boolean} isKept */
  function end(event, isKept) {
    wasDragged.current = ghost.peek() !== null;
    from.current = null;
    ghost.value = null;
    if (!wasDragged.current) return;
    hovered.value = null;
    const place = isKept ? target(event) : null;
    const [key] = place ? add(action, [{ target: place }]) : [];
    if (key) onAdded(key, action, event.pointerType);
  }
  return h("button", {
    type: "button", class: "action button", "aria-pressed": isMine, "data-action": action.name,
    "aria-keyshortcuts": number < 10 ? String(number) : undefined,
    title: number < 10 ? t("trips.key", { n: number }) : undefined,
    onPointerDown: (/** @type {PointerEvent} */ event) => {
      if (event.button) return;
      from.current = event;
      wasDragged.current = false;
      /** @type {Element} */ (event.currentTarget).setPointerCapture(event.pointerId);
    },
    onPointerMove: drag,
    onPointerUp: (/** @type {PointerEvent} */ event) => end(event, true),
    onPointerCancel: (/** @type {PointerEvent} */ event) => end(event, false),
    onClick: (/** @type {MouseEvent} */ { detail }) => {
      if (wasDragged.current) return;
      if (detail === 0 && !isMine) onTake(action); // by a key
      else take(isMine ? null : action);
    },
  }, h(ActionIcon, { action: action.name }), capital(action.name));
}
