// The trips on the map: pins, dragged, moved by the arrow keys, several at once; names beside them and places, which
// avoid each other; the ways from home through them; and the trips of other missions, faintly.

import { computed } from "@preact/signals";
import { h } from "preact";
import { useMemo, useRef } from "preact/hooks";
import { capital, t } from "../core/i18n.js";
import { app, plan, selected, selection } from "../core/station.js";
import { Mark, Tags, useCamera } from "../map/camera.js";
import { landmarkNames } from "../map/ground.js";
import { Dots, Drawn, useMarks } from "../map/many.js";
import { way } from "../map/routes.js";
import { MOST_MARKS, nearest as nearestTo, toPixels, whyNot } from "../map/view.js";
import { called } from "../missions/words.js";
import { copy, meant, nudge, place, remove, where } from "./commands.js";
import { rounded, snapped } from "./snapping.js";
import { abouts, held, hovered, isLocked, markAll, marked, markOne, places, toggle } from "./state.js";

export const BESIDE = 25; // pixels between pins at one place
const SLIP = 4; // pixels that a press may slip and still be a press
/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** @typedef {About & { target: Point }} Placed */

/** Those that lie on the map. */
const lying = computed(() => /** @type {Placed[]} */ (abouts.value.filter(({ target }) => target)));

/** @param {{ target: Point }} one */
const placeOf = ({ target }) => target;

/** Those whose pins are seen, the selected one among them; and those before and after it, so that Tab goes from trip to trip. */
function usePinned() {
  const all = lying.value;
  const marks = useMarks(all, placeOf);
  const { trip } = selection.value;
  return useMemo(() => {
    if (marks === all) return { seen: all, beside: [] };
    const now = all.findIndex(({ key }) => key === trip);
    const chosen = new Set([...marks, ...all.slice(now, now + 1)]);
    const near = all.slice(Math.max(0, now - 1), Math.max(0, now) + 2);
    return { seen: all.filter((about) => chosen.has(about)), beside: near.filter((about) => !chosen.has(about)) };
  }, [all, marks, trip]);
}

/** @param {{ onOpen: (key: string) => void, onRemoved: (next: string | null) => void }} props */
export function Pins({ onOpen, onRemoved }) {
  const all = lying.value;
  const keys = new Set(marked.value);
  const { seen, beside } = usePinned();
  const pins = [...seen, ...beside].sort((a, b) => a.number - b.number);
  return h("g", { class: "layer pins" },
    all.length > MOST_MARKS && [
      h(Dots, { key: "chosen", class: "chosen", places: all.filter(({ key }) => keys.has(key)).map(placeOf) }),
      h(Dots, { key: "all", places: all.map(placeOf) }),
      h(Dots, { key: "bad", class: "bad", places: all.filter(({ problems }) => problems.length).map(placeOf) }),
    ],
    pins.map((about) => h(Mark, { key: about.key, x: about.target[0], y: about.target[1] },
      h(Pin, { about, isBeside: beside.includes(about), onOpen, onRemoved }))));
}

const WITHIN = 21; // pixels of a disc for its number
const MEANT = 14; // pixels from a dot

/** The key of the trip of which a dot was pressed. @param {At} at @param {number} scale */
export const dotAt = (at, scale) =>
  (lying.peek().length > MOST_MARKS ? nearestTo(lying.peek(), placeOf, at, MEANT / scale)?.key ?? null : null);

/** What is read out of a pin. @param {About} about */
function described({ number, trip, target, place: name, problems, isFixed }) {
  const what = [capital(trip.action), ...(trip.name ? [trip.name] : [])].join(" · ");
  const at = [name, t("trips.at", { place: where(/** @type {Point} */ (target)) })].filter(Boolean).join(", ");
  return [
    t("trips.pin", { n: number, what, at }),
    problems.length > 0 && t("trips.pin-problem", { text: problems[0].text }),
    !isFixed && t("trips.pin-keys"),
  ].filter(Boolean).join(" ");
}

/** @param {{ about: About, isBeside: boolean, onOpen: (key: string) => void, onRemoved: (next: string | null) => void }} props isBeside: it is there for the keys alone */
function Pin({ about, isBeside, onOpen, onRemoved }) {
  const { key, number, problems } = about;
  const beside = about.beside * BESIDE;
  const camera = useCamera();
  /** Where it was taken, and how far from its middle. */
  const taken = useRef(/** @type {{ x: number, y: number, dx: number, dy: number, keys: readonly string[], from: Map<string, Point> } | null} */ (null));
  const isChosen = marked.value.includes(key);

  /** @param {PointerEvent} event */
  function take(event) {
    if (event.button) return;
    event.preventDefault();
    const pin = /** @type {SVGGElement} */ (event.currentTarget);
    pin.focus();
    if (event.shiftKey || event.ctrlKey || event.metaKey) {
      toggle(key);
      return;
    }
    if (!isChosen) markOne(key);
    if (about.isFixed) return;
    const disc = /** @type {Element} */ (pin.querySelector(".disc")).getBoundingClientRect();
    const keys = meant(key);
    taken.current = {
      x: event.clientX, y: event.clientY, keys,
      dx: event.clientX - disc.left - disc.width / 2 + beside, dy: event.clientY - disc.top - disc.height / 2,
      from: new Map(abouts.peek().flatMap((one) => (keys.includes(one.key) && one.target && !one.isFixed ? [[one.key, one.target]] : []))),
    };
    pin.setPointerCapture(event.pointerId);
  }
  /** @param {PointerEvent} event */
  function drag(event) {
    const now = taken.current;
    const isPress = now && !held.peek().size && Math.hypot(event.clientX - now.x, event.clientY - now.y) < SLIP;
    if (!now || isPress) return;
    const at = camera.metres({ clientX: event.clientX - now.dx, clientY: event.clientY - now.dy });
    const [x, y] = snapped(at, event.shiftKey, places.peek());
    const [fromX, fromY] = /** @type {Point} */ (now.from.get(key));
    held.value = new Map([...now.from].map(([one, [ax, ay]]) =>
      [one, one === key ? [x, y] : [rounded(ax + x - fromX), rounded(ay + y - fromY)]]));
  }
  /** @param {boolean} isKept */
  function letGo(isKept) {
    if (!taken.current) return;
    taken.current = null;
    const targets = held.peek();
    held.value = new Map();
    if (isKept && targets.size) place(targets);
  }
  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const by = ARROWS[event.key];
    const isCommand = event.ctrlKey || event.metaKey;
    const step = event.shiftKey ? 1 : 0.1;
    if (event.altKey) return;
    if (event.key === "Escape" && taken.current) letGo(false);
    else if (event.key === "Escape" && marked.peek().length > 1) markOne(key);
    else if (event.key === "Enter" && !isCommand) onOpen(key);
    else if (event.key === " ") toggle(key);
    else if (isCommand && event.key === "a") markAll(abouts.peek().map((one) => one.key));
    else if (isLocked.peek()) return;
    else if (isCommand && event.key === "d") copy(meant(key));
    else if (isCommand) return;
    else if (by) nudge(meant(key), by[0] * step, by[1] * step);
    else if (event.key === "Delete" || event.key === "Backspace") onRemoved(remove(meant(key)));
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
  return h("g", {
    class: `pin ${isChosen ? "chosen" : ""} ${problems.length ? "bad" : ""} ${about.isFixed ? "fixed" : ""} ${isBeside ? "beside" : ""}`, transform: `translate(${beside} 0)`,
    role: "button", tabindex: 0, "data-own": true, "data-key": key, "aria-label": described(about),
    onFocus: () => { if (marked.peek().length < 2) markOne(key); },
    onPointerDown: take, onPointerMove: drag, onPointerUp: () => letGo(true),
    onPointerCancel: () => letGo(false), onLostPointerCapture: () => letGo(false), onKeyDown,
  },
  h("circle", { class: "halo", r: 20 }), h("circle", { class: "disc", r: 12.5 }),
  h("text", { y: 4.5, textLength: number > 99 ? WITHIN : undefined, lengthAdjust: "spacingAndGlyphs" }, number),
  problems.length > 0 && h("path", { class: "pin-sign", d: "M11 -20L19 -5H3ZM11 -15v5M11 -8v.5" }));
}

const MOST = 40; // letters

/** @param {string} text */
const short = (text) => (text.length > MOST ? `${text.slice(0, MOST - 1)}…` : text);

/** @param {About} about */
function words({ trip, target, isHeld, place: name, problems }) {
  if (!isHeld) return [capital(trip.action), ...(trip.name ? [trip.name] : [])].join(" · ");
  return problems.find(({ field }) => field === "target")?.text || name || t("trips.metres", { place: where(target ?? []) });
}

/** Where the action in hand would go now. @returns {(Omit<Label, "x" | "y"> & { target: readonly number[] })[]} */
function inTheAir() {
  const target = hovered.value;
  if (!target || !app.value) return [];
  const wrong = whyNot(app.value.map, target);
  const name = places.value.find(({ x, y }) => x === target[0] && y === target[1])?.name;
  const text = wrong ? t(wrong) : name ?? t("trips.metres", { place: where(target) });
  return [{ key: "new", text: short(text), target, importance: 5, always: true, gap: 18, kind: wrong ? "bad" : "" }];
}

export function TripLabels() {
  const camera = useCamera();
  const [view, box] = [camera.view.value, camera.box.value];
  const [chosen, ...others] = marked.value;
  /** @type {(label: Omit<Label, "x" | "y"> & { target: readonly number[], aside?: number }) => Label} */
  const onScreen = ({ target, aside = 0, ...label }) => {
    const { x, y } = toPixels(view, target[0], target[1]);
    return { ...label, x: x + aside, y };
  };
  const pins = usePinned().seen.map((about) => {
    const { key, target, isHeld, problems, beside } = about;
    const isOne = isHeld || (key === chosen && !others.length);
    return onScreen({
      key, target, text: short(words(about)), gap: 18, aside: beside * BESIDE, always: isOne, kind: isHeld && problems.length ? "bad" : "",
      importance: isOne ? 4 : problems.length ? 3 : 2,
    });
  });
  const named = landmarkNames(view, box).map(({ x, y, ...label }) => onScreen({ ...label, target: [x, y] }));
  const marks = pins.map(({ x, y }) => ({ x, y, r: 13 }));
  return h(Tags, { labels: [...inTheAir().map(onScreen), ...pins, ...named], box, marks });
}

/** The home that is nearest to a place. @param {readonly { home: Point }[]} drones @param {Point} to */
function nearest(drones, [x, y]) {
  const far = (/** @type {{ home: Point }} */ { home }) => Math.hypot(home[0] - x, home[1] - y);
  return drones.toSorted((a, b) => far(a) - far(b))[0]?.home;
}

export function Ways() {
  const stops = abouts.value.flatMap(({ target, isHeld, trip: { source } }) => (target
    ? [...(source ? [{ target: source, isHeld: false }] : []), { target, isHeld }] : []));
  const home = stops.length ? nearest(app.value?.drones ?? [], stops[0].target) : undefined;
  const legs = [...(home ? [{ target: home.slice(0, 2), isHeld: false }] : []), ...stops];
  /** @type {Record<string, string[]>} */
  const drawn = { "": [], "from-home": [], "no-way": [] };
  legs.slice(1).forEach(({ target, isHeld }, at) => {
    const from = legs[at];
    const found = isHeld || from.isHeld ? undefined : way([from.target, target]);
    const points = (found ?? [from.target, target]).map(([x, y]) => `${x} ${y}`).join("L");
    drawn[found === null ? "no-way" : home && at === 0 ? "from-home" : ""].push(`M${points}`);
  });
  return h("g", { class: "layer ways" }, Object.entries(drawn).map(([kind, parts]) =>
    h(Drawn, { key: kind, class: kind, parts, title: kind === "no-way" ? t("trips.no-way") : undefined })));
}

/** @param {{ shown: boolean }} props of all other missions, also while one is selected */
export function OtherTrips({ shown }) {
  const isShown = shown || !selected.value;
  const others = plan.missions.value.filter(({ key }) => isShown && key !== selection.value.key);
  const all = useMemo(() => others.flatMap((mission) => mission.trips.flatMap(({ key, target, name }, at) =>
    (target ? [{ key, target, mission, name: name ?? String(at + 1) }] : []))), [plan.missions.value, isShown, selection.value.key]);
  const apart = useMarks(all, placeOf);
  return h("g", { class: "layer other-trips" },
    all.length > MOST_MARKS && h(Dots, { places: all.map(placeOf) }),
    apart.map(({ key, target: [x, y], mission, name }) => h(Mark, { key, x, y }, h("circle", { r: 5 },
      h("title", null, t("trips.other", { mission: called(mission), trip: name }))))));
}
