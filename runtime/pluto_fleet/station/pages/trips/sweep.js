// The sweep of an area, in lanes around what may not be flown over: the station computes it.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { send, StationError } from "../core/api.js";
import { many, number, percent } from "../core/format.js";
import { t } from "../core/i18n.js";
import { landmarks } from "../core/landmarks.js";
import { app } from "../core/station.js";
import { abouts, pattern } from "./state.js";
import { CornerFields, corners, MOST, ToolField } from "./tool_parts.js";

/** @import { Corners } from "./tool_parts.js" */

const PAUSE = 250; // ms until what is being drawn is asked for

/** @param {Corners} corners @returns {Point[]} */
const rectangle = ({ from, to }) => [[from.x, from.y], [to.x, from.y], [to.x, to.y], [from.x, to.y]];

/** A place without the height at which drones cruise anyway. @param {Point} target @returns {Point} */
const flat = ([x, y, z]) => (z === undefined || z === app.peek()?.map.cruise_height ? [x, y] : [x, y, z]);

export function Sweep() {
  const [spacing, setSpacing] = useState("1 m");
  const [zone, setZone] = useState("");
  const [swept, setSwept] = useState(/** @type {Swept | null} */ (null));
  const [wrong, setWrong] = useState("");
  const zones = landmarks.value?.zones ?? [];
  const polygon = zones.find(({ name }) => name === zone)?.corners ?? rectangle(corners());
  const key = JSON.stringify([polygon, spacing]);
  useEffect(() => {
    let isOld = false;
    const before = abouts.peek().at(-1)?.target ?? undefined;
    const timer = setTimeout(async () => {
      try {
        const { data } = await send("POST", "/api/plan/sweep", { polygon, spacing, before });
        if (isOld) return;
        const isTooMany = data.targets.length > MOST;
        pattern.value = isTooMany ? [] : data.targets.map(flat);
        setSwept(isTooMany ? null : data);
        setWrong(isTooMany ? t("trips.count-wrong", { n: MOST }) : "");
      } catch (error) {
        if (!(error instanceof StationError)) throw error;
        if (isOld) return;
        pattern.value = [];
        setSwept(null);
        setWrong(error.message);
      }
    }, PAUSE);
    return () => {
      isOld = true;
      clearTimeout(timer);
    };
  }, [key]);
  return h("div", { class: "stack" },
    zones.length > 0 && h("label", { class: "field" }, h("span", { class: "hint" }, t("trips.zone")), h("select", {
      class: "input", value: zone,
      onChange: (/** @type {Event} */ event) => setZone(/** @type {HTMLSelectElement} */ (event.currentTarget).value),
    }, h("option", { value: "" }, t("trips.zone-drawn")), zones.map(({ name }) => h("option", { key: name, value: name }, name)))),
    !zone && h(CornerFields, null),
    h(ToolField, { label: t("trips.spacing"), value: spacing, numeric: false, onWrite: setSpacing }),
    swept && h("p", { class: "hint" }, t("trips.swept", { trips: many("many.trips", swept.targets.length), metres: number(swept.metres) })),
    swept && swept.forbidden > 0 && h("p", { class: "hint" }, t("trips.swept-forbidden", { share: percent(swept.forbidden) })),
    wrong && h("p", { class: "problem", role: "status" }, wrong));
}
