// A page of which the map is the hero: all the height there is, lists in a rail that folds, full screen.

import { h } from "preact";
import { useRef } from "preact/hooks";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { IconButton } from "./parts.js";

/** @param {{ stage: ComponentChildren, rail: ComponentChildren, tools?: ComponentChildren }} props */
export function MapSplit({ stage, rail, tools }) {
  const element = useRef(/** @type {HTMLDivElement | null} */ (null));
  const isShown = prefs.rail.value;
  const full = () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else element.current?.requestFullscreen();
  };
  return h("div", { class: `map-split ${isShown ? "" : "folded"}` },
    h("div", { class: "map-stage", ref: element }, stage,
      h("div", { class: "map-tools" }, tools,
        h(IconButton, { icon: "full", label: t("full-screen"), onClick: full }),
        h(IconButton, {
          icon: "rail", label: t(isShown ? "rail.hide" : "rail.show"), expanded: isShown,
          onClick: () => { prefs.rail.value = !isShown; },
        }))),
    h("aside", { class: "rail", "aria-label": t("rail") }, rail));
}
