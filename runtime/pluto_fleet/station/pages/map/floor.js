// The floor plan: one SVG in metres, y upwards, that is zoomed and moved by wheel, fingers and keys. What
// stands in a Mark is drawn in pixels, y downwards, and keeps its size at every zoom; what has
// `data-own` has its pointers to itself.

import { effect, signal } from "@preact/signals";
import { h } from "preact";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { number } from "../core/format.js";
import { t } from "../core/i18n.js";
import { Button, IconButton } from "../ui/button.js";
import { Seen } from "./camera.js";
import { Ground, Rulers, ScaleBar } from "./ground.js";
import { hands } from "./hands.js";

/** @import { Camera } from "./camera.js" */

/**
 * @param {object} props
 * @param {MapShape} props.map
 * @param {Camera} props.camera
 * @param {ComponentChildren} [props.children] in metres, over the ground
 * @param {ComponentChildren} [props.overlay] HTML above the map
 * @param {ComponentChildren} [props.tools] more buttons at its foot
 * @param {string} [props.class]
 * @param {(at: At, event: PointerEvent) => void} [props.onPlace] the ground was pressed, and not dragged
 */
export function Floor({ map, camera, children, overlay, tools, class: more = "", onPlace }) {
  const picture = useRef(/** @type {SVGSVGElement | null} */ (null));
  const world = useRef(/** @type {SVGGElement | null} */ (null));
  const pointed = useMemo(() => signal(/** @type {At | null} */ (null)), []);
  const place = useRef(onPlace);
  place.current = onPlace;

  useLayoutEffect(() => { // before it is painted: the map fills its box in the first frame
    const element = /** @type {SVGSVGElement} */ (picture.current);
    camera.picture = element;
    const measure = () => {
      if (element.clientWidth && element.clientHeight) camera.resize(element.clientWidth, element.clientHeight);
    };
    measure();
    const measured = new ResizeObserver(measure);
    measured.observe(element);
    const stop = effect(() => { // not by drawing anew: a map is moved sixty times a second
      const { left, bottom, scale } = camera.view.value;
      world.current?.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${left} ${bottom})`);
      element.style.setProperty("--metre", String(1 / scale));
      element.classList.toggle("whole", camera.isWhole.value);
    });
    const off = hands(element, camera, (at, event) => place.current?.(at, event));
    return () => {
      measured.disconnect();
      stop();
      off();
    };
  }, [camera]);

  const [width, height] = map.size;
  /** @param {MouseEvent} event */
  const point = (event) => {
    const { x, y } = camera.metres(event);
    pointed.value = x >= 0 && y >= 0 && x <= width && y <= height ? { x, y } : null;
  };
  return h(Seen.Provider, { value: camera },
    h("div", { class: `floor ${more}` },
      h("svg", {
        ref: picture, class: "floor-picture", role: "application", tabindex: 0,
        "aria-label": t("map.label", { width, height }),
        onPointerMove: point, onDragOver: point, onPointerLeave: () => { pointed.value = null; },
      }, h("g", { ref: world, class: "world" }, h(Ground, { map }), children), h(Rulers, { map })),
      overlay,
      h("div", { class: "floor-foot" },
        h(Pointed, { pointed }), h(ScaleBar, null), tools,
        h(IconButton, { icon: "minus", label: t("map.zoom-out"), onClick: () => camera.zoom(1 / 1.4) }),
        h(IconButton, { icon: "plus", label: t("map.zoom-in"), onClick: () => camera.zoom(1.4) }),
        h(Button, { small: true, kind: "quiet", onClick: () => camera.whole() }, t("map.whole")))));
}

/** Where the pointer is. @param {{ pointed: Signal<At | null> }} props */
function Pointed({ pointed }) {
  const at = pointed.value;
  const two = { minimumFractionDigits: 2, maximumFractionDigits: 2 };
  return h("span", { class: "pointed num", "aria-hidden": true },
    at && `x ${number(at.x, two)} m   y ${number(at.y, two)} m`);
}
