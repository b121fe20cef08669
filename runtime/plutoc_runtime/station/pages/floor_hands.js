// What hands do with a floor plan: the wheel and two fingers zoom, dragging the ground moves it,
// and so do the arrow keys. What has `data-own` (a pin) looks after its own pointers.

const STEP = 60; // pixels an arrow key moves the map

export function hands(element, act) {
  const fingers = new Map();
  const at = (event) => {
    const box = element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };

  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 : 1;
    act.zoom(1.0015 ** -(event.deltaY * lines), at(event));
  }, { passive: false });

  element.addEventListener("pointerdown", (event) => {
    if (event.button > 0 || event.target.closest("[data-own]")) return;
    fingers.set(event.pointerId, at(event));
    element.setPointerCapture(event.pointerId);
  });

  element.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = at(event);
    if (fingers.size === 1) {
      act.move(now.x - before.x, now.y - before.y);
    } else {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      pinch(act, before, now, other);
    }
    fingers.set(event.pointerId, now);
    element.classList.add("held");
  });

  const let_go = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) element.classList.remove("held");
  };
  element.addEventListener("pointerup", let_go);
  element.addEventListener("pointercancel", let_go);

  element.addEventListener("keydown", (event) => {
    if (event.target !== element || event.ctrlKey || event.metaKey || event.altKey) return;
    const done = {
      ArrowLeft: () => act.move(STEP, 0),
      ArrowRight: () => act.move(-STEP, 0),
      ArrowUp: () => act.move(0, STEP),
      ArrowDown: () => act.move(0, -STEP),
      "+": () => act.zoom(1.4),
      "=": () => act.zoom(1.4),
      "-": () => act.zoom(1 / 1.4),
      0: () => act.whole(),
    }[event.key];
    if (!done) return;
    event.preventDefault();
    done();
  });
}

/** One of two fingers has moved: the middle between them moves half as far. */
function pinch(act, before, now, other) {
  const apart = (finger) => Math.max(10, Math.hypot(finger.x - other.x, finger.y - other.y));
  act.move((now.x - before.x) / 2, (now.y - before.y) / 2);
  act.zoom(apart(now) / apart(before), { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 });
}
