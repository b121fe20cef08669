// What changes often, told a few times a second: for what is costly to draw.

import { effect, signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";

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
