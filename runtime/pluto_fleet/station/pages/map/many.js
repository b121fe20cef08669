// Many places at once on a map. As long as they are few, each has a mark of its own. Of more only those in view have
// one, if these are few, and all are dots as well, which are one element: it is moved sixty times a second.

import { h } from "preact";
import { useMemo } from "preact/hooks";
import { useCalm } from "../ui/hooks.js";
import { useCamera } from "./camera.js";
import { marksOf, MOST_MARKS } from "./view.js";

const MARKS_EVERY = 100; // ms

/** Those that have one now, looked at a few times a second. @template Thing @param {readonly Thing[]} all @param {(one: Thing) => readonly number[]} at */
export function useMarks(all, at) {
  const camera = useCamera();
  const calm = useCalm(camera.view, MARKS_EVERY);
  const [view, box] = all.length <= MOST_MARKS ? [camera.view.peek(), camera.box.peek()] : [calm.value, camera.box.value];
  return useMemo(() => marksOf(all, at, view, box), all.length <= MOST_MARKS ? [all] : [all, view, box]);
}

const TOGETHER = 100; // parts of one element: what of a large one is not in view is painted all the same

/**
 * What of many parts is drawn alike, in few elements.
 * @param {{ parts: readonly string[], class?: string, title?: string }} props parts: as in the d of a path
 */
export function Drawn({ parts, class: more = "", title }) {
  const elements = Array.from({ length: Math.ceil(parts.length / TOGETHER) }, (_, at) =>
    parts.slice(at * TOGETHER, (at + 1) * TOGETHER).join(""));
  return elements.map((d, at) => h("path", { key: at, class: more, d }, title && h("title", null, title)));
}

/** Places as dots, in metres. @param {{ places: readonly (readonly number[])[], class?: string }} props */
export const Dots = ({ places, class: more = "" }) =>
  h(Drawn, { class: `dots ${more}`, parts: places.map(([x, y]) => `M${x} ${y}h0`) });
