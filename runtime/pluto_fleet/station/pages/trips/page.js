// The trips of a mission, on the map and as cards.

import { h } from "preact";
import { useEffect, useId, useMemo, useState } from "preact/hooks";
import { addMission, newKey } from "../core/changes.js";
import { many, t } from "../core/i18n.js";
import { wantedField } from "../core/route.js";
import { app, mayFly, plan, selected, selection, selectKey } from "../core/station.js";
import { Camera, Mark } from "../map/camera.js";
import { Homes } from "../map/fleet.js";
import { Floor, MapSplit } from "../map/floor.js";
import { Landmarks } from "../map/ground.js";
import { MissionField } from "../missions/panel.js";
import { called } from "../missions/words.js";
import { Button, Check, Icon, Said } from "../ui/parts.js";
import { Others } from "../ui/people.js";
import { UndoButtons } from "../ui/undo.js";
import { focusField, focusHead, SeveralTrips, TripCards } from "./cards.js";
import { PICK } from "./carried.js";
import { add } from "./commands.js";
import { Palette, take } from "./palette.js";
import { dotAt, OtherTrips, Pins, TripLabels, Ways } from "./pins.js";
import { snapped } from "./snapping.js";
import { abouts, hovered, inHand, isLocked, marked, markOne, pattern, places, toggle, tool } from "./state.js";
import { Drawing, Drawn, ToolButtons, ToolPanel } from "./tools.js";

/** @import { Added } from "./palette.js" */

const MOST_OFFERED = 8; // missions

/** How heavy an item is, only people know: its field is next, but on a screen that is touched. @type {Added} */
function onAdded(key, action, by) {
  if (action.name === PICK && by !== "touch") focusField(key, "item.name");
}

export default function Page() {
  const shape = /** @type {AppShape} */ (app.value);
  const camera = useMemo(() => new Camera(shape.map.size), [shape]);
  const [areOthersShown, showOthers] = useState(true);
  const wanted = wantedField.value;
  const [chosen] = marked.value;
  useEffect(() => {
    const target = abouts.peek().find(({ key }) => key === chosen)?.target;
    if (target) camera.reveal(target[0], target[1]);
  }, [chosen, camera]);
  useEffect(() => {
    if (!wanted) return;
    if (wanted.trip) focusField(wanted.trip, wanted.field ?? undefined);
    else focusPalette();
    wantedField.value = null;
  }, [wanted]);
  useEffect(() => { if (!wanted && document.activeElement === document.body) focusPalette(); }, []);
  const mission = selected.value;
  if (!plan.isLoaded.value) return null;

  /** @param {At} at @param {PointerEvent} event */
  function onPlace(at, event) {
    const action = inHand.peek();
    if (!action) {
      const meant = dotAt(at, camera.view.peek().scale);
      if (meant && (event.ctrlKey || event.metaKey)) toggle(meant);
      else if (meant || marked.peek().length > 1) markOne(meant);
      return;
    }
    const [key] = add(action, [{ target: snapped(at, event.shiftKey, places.peek()) }]);
    take(null);
    if (key) onAdded(key, action, event.pointerType);
  }
  /** @param {PointerEvent} event */
  function onMove(event) {
    if (!inHand.peek() || event.pointerType !== "mouse") return;
    hovered.value = camera.picture?.contains(/** @type {Node} */ (event.target))
      ? snapped(camera.metres(event), event.shiftKey, places.peek()) : null;
  }
  const canDraw = mission !== null && !isLocked.value;
  const isAiming = inHand.value !== null || tool.value !== null;
  return h("div", { class: "trips" }, h(MapSplit, {
    tools: [mayFly.value && h(UndoButtons, { key: "undo" }), canDraw && h(ToolButtons, { key: "tools" })],
    stage: h(Drawing, { camera, class: `trips-stage ${canDraw ? "drawable" : ""}`, onMove },
      canDraw && h(Palette, { camera, onAdded, onNew: newMission }),
      h(Floor, {
        map: shape.map, camera, class: isAiming ? "aiming" : "", onPlace, overlay: h(TripLabels, null),
        children: [
          h(Homes, { key: "homes", app: shape }), h(Landmarks, { key: "landmarks" }),
          h(OtherTrips, { key: "others", shown: areOthersShown }), h(Ways, { key: "ways" }),
          h("g", { key: "drawn", class: "layer" }, h(Drawn, null)), h(Preview, { key: "preview" }),
          h(Pins, { key: "pins", onOpen: focusField, onRemoved: focusPin }),
        ],
      }),
      canDraw && h(ToolPanel, { onAdded: () => focusHead(abouts.peek().at(-1)?.key ?? null) })),
    rail: [
      h(Picker, { key: "picker", areOthersShown, showOthers }),
      h("div", { key: "body", class: "rail-body stack" }, mission ? h(Trips, { mission }) : h(First, null)),
    ],
  }));
}

const focusPalette = () => requestAnimationFrame(() =>
  /** @type {HTMLElement | null} */ (document.querySelector(".palette .action"))?.focus());

/** @param {string | null} next */
const focusPin = (next) => requestAnimationFrame(() =>
  /** @type {HTMLElement | null} */ (document.querySelector(`.pin[data-key="${next}"]`))?.focus());

/** The pins that would be put now. */
function Preview() {
  const lines = hovered.value ? [] : pattern.value.flatMap(({ source, target }) => (source ? [{ source, target }] : []));
  const targets = hovered.value ? [hovered.value] : pattern.value.map(({ target }) => target);
  return h("g", { class: "layer preview", "aria-hidden": true }, lines.map(({ source, target }, at) =>
    h("line", { key: `line ${at}`, class: "drawn", x1: source[0], y1: source[1], x2: target[0], y2: target[1] })),
  targets.map(([x, y], at) =>
    h(Mark, { key: at, x, y }, h("g", { class: "pin new" }, h("circle", { class: "disc", r: 12.5 }), h("text", { y: 4.5 }, "+")))));
}

/** Make a mission here, and go to its name. */
function newMission() {
  const key = newKey();
  plan.edit(addMission(key, t("mission")));
  selectKey(key);
  requestAnimationFrame(() => {
    const name = /** @type {HTMLInputElement | null} */ (document.querySelector(".trips-head [data-field=name] input"));
    name?.focus();
    name?.select();
  });
}

const NewMission = ({ kind = /** @type {"" | "primary"} */ ("") }) => (mayFly.value
  ? h(Button, { kind, icon: "plus", onClick: newMission }, t("trips.new-mission")) : null);

/** @param {{ areOthersShown: boolean, showOthers: (shown: boolean) => void }} props */
function Picker({ areOthersShown, showOthers }) {
  const id = useId();
  const missions = plan.missions.value;
  const { key } = selection.value;
  if (!missions.length) return null;
  return h("div", { class: "mission-bar" },
    h("label", { for: id, class: "hint" }, t("mission")),
    h("div", { class: "row picker" },
      h("select", {
        id, class: "input", value: key ?? "",
        onChange: (/** @type {Event} */ event) => selectKey(/** @type {HTMLSelectElement} */ (event.currentTarget).value || null),
      }, h("option", { value: "", hidden: key !== null }, t("trips.choose-mission")),
      missions.map((one) => h("option", { key: one.key, value: one.key },
        t("trips.mission-option", { mission: called(one), trips: many("many.trips", one.trips.length) })))),
      h(NewMission, null), h(Others, null)),
    missions.length > 1 && h(Check, { checked: areOthersShown, onTick: showOthers }, t("trips.show-others")));
}

/** @param {{ mission: PlanMission }} props */
function Trips({ mission }) {
  const { key, launched, trips } = mission;
  const own = plan.problems.value.filter((one) => one.mission === key && !one.trip && one.field !== "name");
  return h("section", { class: "stack", "aria-label": t("trips.of-mission") },
    launched && h("p", { class: "hint" }, t(isLocked.value ? "trips.locked" : "trips.under-way")),
    h("div", { class: "trips-head" }, h(MissionField, { key, mission, field: { name: "name", type: "text", label: t("trips.mission-name") }, onKeyDown: toPalette })),
    trips.length > 0 && own.map(({ text, isOwn }) => h("p", { key: text, class: "problem" }, h(Icon, { name: "warning" }), h(Said, { text, isOwn }))),
    h(SeveralTrips, null), h(TripCards, null),
    !isLocked.value && h("p", { class: "hint" }, t(trips.length ? "trips.how-to-order" : "trips.none-yet")));
}

/** Enter in the mission's name goes on to its trips. @param {KeyboardEvent} event */
function toPalette(event) {
  if (event.key !== "Enter") return;
  event.preventDefault();
  focusPalette();
}

/** What is to be done before trips can be drawn. */
function First() {
  const missions = plan.missions.value;
  if (!missions.length) {
    return h("section", { class: "stack" },
      h("h2", null, t("trips.first-make")), h("p", null, t("trips.first-make-more")),
      h("div", null, h(NewMission, { kind: "primary" })));
  }
  return h("section", { class: "stack" },
    h("h2", null, t("trips.first-choose")), h("p", null, t("trips.first-choose-more")),
    h("div", { class: "row" }, missions.slice(0, MOST_OFFERED).map((one) =>
      h(Button, { key: one.key, onClick: () => selectKey(one.key) }, called(one)))));
}
