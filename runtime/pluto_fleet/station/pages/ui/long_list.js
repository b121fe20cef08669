// A long list of which only those items are drawn that are in sight, and some before and after; gaps stand for the others.

import { h } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";

const LONG = 100; // items; a list with fewer is drawn whole
const BEYOND = 15; // items before and after those in sight

/** @typedef {{ at: number, gap: number }} Part an item, or a gap of so many from there on */

/** @param {number} count of the items @param {(at: number) => boolean} isDrawn @returns {Part[]} */
function parts(count, isDrawn) {
  /** @type {Part[]} */
  const found = [];
  for (let at = 0; at < count; at += 1) {
    const last = found.at(-1);
    if (isDrawn(at)) found.push({ at, gap: 0 });
    else if (last?.gap) last.gap += 1;
    else found.push({ at, gap: 1 });
  }
  return found;
}

/** The places of items in a list, seen between two heights. @param {HTMLElement} list @param {{ top: number, bottom: number }} sight */
function seen(list, { top, bottom }) {
  return /** @type {HTMLElement[]} */ ([...list.children]).flatMap((child) => {
    const box = child.getBoundingClientRect();
    if (box.bottom < top || box.top > bottom) return [];
    const at = (/** @type {number} */ y) =>
      Number(child.dataset.at) + Math.floor((Number(child.dataset.gap || 1) * (y - box.top)) / (box.height + 1));
    return [at(Math.max(top, box.top)), at(Math.min(bottom, box.bottom))];
  });
}

/**
 * What is drawn of a list that scrolls in a rail; its elements say at which place each is, as `data-at`. Where the focus
 * is, and beside it, items are drawn in any case: Tab goes on from there.
 * @param {{ current: HTMLElement | null }} list @param {number} count of its items
 * @param {readonly number[]} [kept] others that are drawn in any case
 */
export function useLongList(list, count, kept = []) {
  const isLong = count > LONG;
  const [sight, setSight] = useState({ from: 0, to: 3 * BEYOND });
  const [focused, setFocused] = useState(-2);
  useLayoutEffect(() => {
    const element = list.current;
    const rail = element?.closest(".rail-body");
    if (!element || !rail || !isLong) return undefined;
    const look = () => {
      const all = seen(element, rail.getBoundingClientRect());
      const [from, to] = [Math.min(...all), Math.max(...all) + 1];
      setSight((now) => (!all.length || (from >= now.from && to <= now.to) ? now
        : { from: from - BEYOND, to: to + BEYOND }));
    };
    look();
    const measured = new ResizeObserver(look);
    measured.observe(rail);
    const over = new AbortController();
    rail.addEventListener("scroll", look, { passive: true, signal: over.signal });
    element.addEventListener("focusin", ({ target }) => {
      const item = /** @type {HTMLElement | null} */ (/** @type {Element} */ (target).closest("[data-at]"));
      if (item) setFocused(Number(item.dataset.at));
    }, { signal: over.signal });
    return () => {
      measured.disconnect();
      over.abort();
    };
  }, [list, count, isLong]);
  return parts(count, (at) => !isLong || (at >= sight.from && at < sight.to)
    || [focused, ...kept].some((one) => Math.abs(one - at) < 2));
}

/** Stands for items that are not drawn. @param {Part & { height: number }} props height: of one, in pixels, about */
export const Gap = ({ at, gap, height }) =>
  h("li", { "aria-hidden": true, "data-at": at, "data-gap": gap, style: { height: `${gap * height}px` } });
