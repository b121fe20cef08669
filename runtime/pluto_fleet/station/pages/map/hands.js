// How the map is moved and zoomed: by wheel, by one finger or two, by keys.

/** @import { Camera } from "./camera.js" */

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
