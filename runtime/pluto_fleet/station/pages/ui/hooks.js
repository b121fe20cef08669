// What several components do: what changes often is told a few times a second, the station is asked, and the items of
// a list change their order by dragging.

import { effect, signal } from "@preact/signals";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { ofStation } from "../core/api.js";

/**
 * A signal's value, at once and then at most every `every` milliseconds; the last one is always told.
 * @template Value
 * @param {ReadonlySignal<Value>} source @param {number} every
 * @returns {ReadonlySignal<Value>}
 */
export function useCalm(source, every) {
  const calm = useMemo(() => signal(source.peek()), [source]);
  useEffect(() => {
    let timer = 0;
    const stop = effect(() => {
      void source.value;
      timer ||= setTimeout(() => {
        timer = 0;
        calm.value = source.peek();
      }, every);
    });
    return () => {
      stop();
      clearTimeout(timer);
    };
  }, [source, calm, every]);
  return calm;
}

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
    const next = others.find((item) => {
      const { top, height } = item.getBoundingClientRect();
      return y < top + height / 2;
    });
    const without = keys.filter((one) => one !== key);
    const at = (/** @type {HTMLElement | undefined} */ item) => without.indexOf(item?.dataset.key ?? ""); // not all are drawn of a long list
    return next ? at(next) : at(others.at(-1)) + 1;
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

/**
 * What the station answers; asked when it is shown, and whenever a key changes, as soon as that has settled.
 * Until then, or if it says no, there is no data.
 * @template Data
 * @param {readonly unknown[]} keys what the answer is of
 * @param {() => Promise<Data>} ask @param {{ anew?: unknown, settles?: number }} [more] anew: asked again when it changes; settles: ms
 * @returns {Answer<Data>}
 */
export function useAnswer(keys, ask, { anew, settles = 0 } = {}) {
  const nothing = useMemo(() => ({ data: null, trouble: "" }), keys);
  const [answer, setAnswer] = useState({ of: nothing, said: /** @type {Answer<Data>} */ (nothing) });
  useEffect(() => {
    let isOld = false;
    const timer = setTimeout(() => ask().then(
      (data) => ({ data, trouble: "" }), (error) => ({ data: null, trouble: ofStation(error).message }),
    ).then((said) => { if (!isOld) setAnswer({ of: nothing, said }); }), settles);
    return () => {
      isOld = true;
      clearTimeout(timer);
    };
  }, [nothing, anew]);
  return answer.of === nothing ? answer.said : nothing;
}
