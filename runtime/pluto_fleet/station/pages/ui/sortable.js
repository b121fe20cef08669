// A list of which the items change their order by dragging; a finger takes them by the grip, elsewhere
// it scrolls.

import { useRef, useState } from "preact/hooks";

const SLIP = 6; // pixels that a press may slip and still be a press
const PRESSED = "button:not(.trip-head), input, select, textarea, a";

/**
 * @param {readonly string[]} keys of the items, each of which has its own as `data-key`
 * @param {(key: string, to: number) => void} onMove
 * @param {boolean} [locked]
 */
export function useSortable(keys, onMove, locked = false) {
  const list = useRef(/** @type {HTMLElement | null} */ (null));
  const [drag, setDrag] = useState(/** @type {{ key: string, to: number } | null} */ (null));
  const pressed = useRef(/** @type {{ key: string, y: number, id: number } | null} */ (null));

  /** @param {string} key @param {number} y */
  function placeAt(key, y) {
    const items = /** @type {HTMLElement[]} */ ([...(list.current?.children ?? [])]).filter((item) => item.dataset.key);
    const others = items.filter((item) => item.dataset.key !== key);
    const at = others.findIndex((item) => {
      const { top, height } = item.getBoundingClientRect();
      return y < top + height / 2;
    });
    return at < 0 ? others.length : at;
  }
  const rest = keys.filter((key) => key !== drag?.key);
  return {
    /** The keys, in the order in which they are to be shown now. */
    order: drag ? rest.toSpliced(drag.to, 0, drag.key) : keys,
    dragged: drag?.key ?? null,
    hands: {
      ref: list,
      onPointerDown: (/** @type {PointerEvent} */ event) => {
        const target = /** @type {Element} */ (event.target);
        const item = /** @type {HTMLElement | null} */ (target.closest("[data-key]"));
        if (locked || event.button || !item || target.closest(PRESSED)) return;
        if (event.pointerType !== "mouse" && !target.closest(".grip")) return;
        pressed.current = { key: /** @type {string} */ (item.dataset.key), y: event.clientY, id: event.pointerId };
      },
      onPointerMove: (/** @type {PointerEvent} */ { clientY }) => {
        const now = pressed.current;
        if (!now || (!drag && Math.abs(clientY - now.y) < SLIP)) return;
        list.current?.setPointerCapture(now.id); // and what was pressed is not clicked
        setDrag({ key: now.key, to: placeAt(now.key, clientY) });
      },
      onPointerUp: () => {
        pressed.current = null;
        setDrag(null);
        if (drag && keys[drag.to] !== drag.key) onMove(drag.key, drag.to);
      },
      onPointerCancel: () => {
        pressed.current = null;
        setDrag(null);
      },
    },
  };
}
