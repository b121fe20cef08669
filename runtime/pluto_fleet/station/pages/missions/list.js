// The list of missions: selected by press and keys, several at once, moved by dragging.

import { h } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import { t } from "../core/i18n.js";
import { app, mayFly, plan, selection } from "../core/station.js";
import { useSortable } from "../ui/hooks.js";
import { Chip, Icon } from "../ui/parts.js";
import { Touching } from "../ui/people.js";
import { extendTo, isMarking, markAll, marked, markOne, move, open, remove, shift, toggle } from "./commands.js";
import { called, inShort, standing } from "./words.js";

/** @param {{ onRename: () => void }} props */
export function MissionList({ onRename }) {
  const missions = plan.missions.value;
  const keys = missions.map(({ key }) => key);
  const { key: selected } = selection.value;
  const id = useId();
  const { order, dragged, hands } = useSortable(keys, (key, to) => {
    move(key, to);
    markOne(key);
  }, !mayFly.value);
  const by = new Map(missions.map((mission) => [mission.key, mission]));

  /** @param {MouseEvent} event @param {string} key */
  function press(event, key) {
    if (event.shiftKey) extendTo(key);
    else if (event.ctrlKey || event.metaKey || isMarking.peek()) toggle(key);
    else markOne(key);
  }
  /** @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const now = selection.peek().key;
    const at = now === null ? -1 : keys.indexOf(now);
    const by1 = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const next = by1 && keys.length ? keys[Math.min(Math.max(at + by1, 0), keys.length - 1)] : undefined;
    if (by1 && event.altKey && now) shift(now, by1);
    else if (next) (event.shiftKey ? extendTo : markOne)(next);
    else if (event.key === "a" && (event.ctrlKey || event.metaKey)) markAll(keys);
    else if (event.key === "Escape" && marked.peek().length > 1) markOne(now);
    else if (!now) return;
    else if (event.key === "Enter") open(now);
    else if (event.key === "F2") onRename();
    else if (event.key === "Delete") remove(marked.peek());
    else return;
    event.preventDefault();
  }
  return h("ol", {
    ...hands, class: "mission-list", role: "listbox", tabIndex: 0, "aria-label": t("page.missions"),
    "aria-multiselectable": true, onKeyDown,
    "aria-activedescendant": selected && by.has(selected) ? `${id}-${selected}` : undefined,
  }, order.map((key) => h(Item, {
    key, id: `${id}-${key}`, mission: /** @type {PlanMission} */ (by.get(key)), at: keys.indexOf(key),
    isDragged: key === dragged, isShown: key === selected, onPress: press,
  })));
}

/** @param {{ id: string, mission: PlanMission, at: number, isDragged: boolean, isShown: boolean, onPress: (event: MouseEvent, key: string) => void }} props */
function Item({ id, mission, at, isDragged, isShown, onPress }) {
  const { fields } = /** @type {AppShape} */ (app.value);
  const element = useRef(/** @type {HTMLLIElement | null} */ (null));
  useEffect(() => { if (isShown) element.current?.scrollIntoView({ block: "nearest" }); }, [isShown, at]);
  const how = standing(mission, plan.problems.value, fields.mission);
  const { key } = mission;
  return h("li", {
    ref: element, id, role: "option", "data-key": key, "aria-selected": marked.value.includes(key),
    class: `mission ${isShown ? "shown" : ""} ${isDragged ? "dragged" : ""}`,
    onClick: (/** @type {MouseEvent} */ event) => onPress(event, key), onDblClick: () => open(key),
  },
  h("span", { class: "grip" }, h(Icon, { name: "grip" })),
  h("span", { class: "mission-number num" }, at + 1),
  h("span", { class: "mission-words" }, h("strong", { class: "called" }, called(mission)),
    h("span", { class: "hint" }, inShort(mission, fields.mission))),
  h(Touching, { keys: [key, ...mission.trips.map((trip) => trip.key)] }),
  how && h(Chip, how.icon ? { kind: how.kind, icon: how.icon } : { kind: how.kind }, how.text));
}
