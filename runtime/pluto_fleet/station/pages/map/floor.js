// The floor plan: one SVG in metres, y upwards, that is zoomed and moved by wheel, fingers and keys. What
// stands in a Mark is drawn in pixels, y downwards, and keeps its size at every zoom; what has
// `data-own` has its pointers to itself. And the page of which it is the hero, with lists in a rail that folds.

import { effect, signal } from "@preact/signals";
import { h } from "preact";
import { useLayoutEffect, useMemo, useRef } from "preact/hooks";
import { number, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { Button, IconButton } from "../ui/parts.js";
import { Seen } from "./camera.js";
import { Ground, Rulers, ScaleBar } from "./ground.js";

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

const STEP = 60; // pixels that an arrow key moves the map
const SLIP = 5; // pixels that a press may slip and still be a press
const BY = 1.4;

/**
 * Let a picture be moved; returns what ends that.
 * @param {SVGSVGElement} picture @param {Camera} camera
 * @param {(at: At, event: PointerEvent) => void} onPlace the ground was pressed, in metres
 */
export function hands(picture, camera, onPlace) {
  /** @type {Map<number, At>} */
  const fingers = new Map();
  /** @type {At | null} where a press began that has not slipped yet */
  let pressed = null;
  const ended = new AbortController();
  const options = { passive: false, signal: ended.signal };

  picture.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(1.0015 ** -(event.deltaY * (event.deltaMode ? 30 : 1)), camera.inside(event));
  }, options);
  picture.addEventListener("pointerdown", (event) => {
    if (event.button || /** @type {Element} */ (event.target).closest("[data-own]")) return;
    pressed = fingers.size ? null : camera.inside(event);
    fingers.set(event.pointerId, camera.inside(event));
    picture.setPointerCapture(event.pointerId);
  }, options);
  picture.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = camera.inside(event);
    if (pressed && Math.hypot(now.x - pressed.x, now.y - pressed.y) < SLIP) return;
    pressed = null;
    const other = [...fingers.values()].find((finger) => finger !== before);
    const half = other ? 2 : 1; // the middle between two fingers moves half as far as one of them
    camera.move((now.x - before.x) / half, (now.y - before.y) / half);
    if (other) {
      const apart = (/** @type {At} */ one) => Math.max(10, Math.hypot(one.x - other.x, one.y - other.y));
      camera.zoom(apart(now) / apart(before), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
    }
    fingers.set(event.pointerId, now);
  }, options);
  const end = (/** @type {PointerEvent} */ event) => {
    if (!fingers.delete(event.pointerId)) return;
    if (pressed && event.type === "pointerup") onPlace(camera.metres(event), event);
    pressed = null;
  };
  picture.addEventListener("pointerup", end, options);
  picture.addEventListener("pointercancel", end, options);
  picture.addEventListener("keydown", (event) => {
    if (event.target !== picture || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = /** @type {Record<string, () => void>} */ ({
      ArrowLeft: () => camera.move(STEP, 0), ArrowRight: () => camera.move(-STEP, 0),
      ArrowUp: () => camera.move(0, STEP), ArrowDown: () => camera.move(0, -STEP),
      "+": () => camera.zoom(BY), "=": () => camera.zoom(BY), "-": () => camera.zoom(1 / BY),
      0: () => camera.whole(),
    })[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }, options);
  return () => ended.abort();
}

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
