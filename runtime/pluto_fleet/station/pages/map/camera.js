// The camera over a floor plan: what it sees, and how it is moved.

import { signal } from "@preact/signals";
import { createContext, h } from "preact";
import { useContext } from "preact/hooks";
import { LINE, placed } from "./labels.js";
import { between, kept, toMetres, toPixels, whole, zoomed } from "./view.js";

const EDGE = 60; // pixels that a revealed place keeps from the edge

/** The camera over one floor plan: what it sees, and how it is moved. */
export class Camera {
  /** @param {readonly number[]} size of the map, in metres */
  constructor(size) {
    this.size = size;
    this.box = signal(/** @type {Box} */ ({ width: 0, height: 0 }));
    this.view = signal(/** @type {View} */ ({ left: 0, bottom: 0, scale: 40 }));
    this.isWhole = signal(true);
    /** @type {SVGSVGElement | null} */
    this.picture = null;
  }

  /** @param {View} view */
  look(view) {
    this.isWhole.value = false;
    this.view.value = kept(view, this.box.peek(), this.size);
  }

  whole() {
    this.isWhole.value = true;
    this.view.value = whole(this.box.peek(), this.size);
  }

  /** @param {number} factor @param {At} [at] a pixel */
  zoom(factor, at) {
    const { width, height } = this.box.peek();
    this.isWhole.value = false;
    const middle = { x: width / 2, y: height / 2 };
    this.view.value = zoomed(this.view.peek(), factor, at ?? middle, this.box.peek(), this.size);
  }

  /** @param {number} dx @param {number} dy pixels */
  move(dx, dy) {
    const { left, bottom, scale } = this.view.peek();
    this.look({ left: left + dx, bottom: bottom + dy, scale });
  }

  /** Show a place, in metres, at a scale if it is given. @param {number} x @param {number} y @param {number} [scale] */
  reveal(x, y, scale) {
    const { width, height } = this.box.peek();
    if (!width) return;
    if (scale && scale > this.view.peek().scale) {
      this.look({ scale, left: width / 2 - x * scale, bottom: height / 2 + y * scale });
      return;
    }
    const at = toPixels(this.view.peek(), x, y);
    const dx = between(at.x, EDGE, Math.max(EDGE, width - EDGE)) - at.x;
    const dy = between(at.y, EDGE, Math.max(EDGE, height - EDGE)) - at.y;
    if (dx || dy) this.move(dx, dy);
  }

  /** @param {number} width @param {number} height */
  resize(width, height) {
    const before = this.box.peek();
    this.box.value = { width, height };
    if (this.isWhole.peek()) this.whole();
    else this.move((width - before.width) / 2, (height - before.height) / 2);
  }

  /** The pixel of a pointer. @param {{ clientX: number, clientY: number }} event @returns {At} */
  inside({ clientX, clientY }) {
    const at = /** @type {SVGSVGElement} */ (this.picture).getBoundingClientRect();
    return { x: clientX - at.left, y: clientY - at.top };
  }

  /** Where a pointer is, in metres. @param {{ clientX: number, clientY: number }} event */
  metres(event) {
    return toMetres(this.view.peek(), this.inside(event));
  }
}

export const Seen = createContext(/** @type {Camera | null} */ (null));

/** The camera of the floor plan around. @returns {Camera} */
export const useCamera = () => /** @type {Camera} */ (useContext(Seen));

/** What is drawn in pixels at a place in metres. @param {{ x: number, y: number, class?: string, children?: ComponentChildren }} props */
export const Mark = ({ x, y, class: more = "", children }) =>
  h("g", { class: `mark ${more}`, transform: `translate(${x} ${y})` },
    h("g", { class: "keeps-size" }, children));

/**
 * Names in a box of pixels, as far as they have room.
 * @param {{ labels: readonly Label[], box: Box, marks?: readonly { x: number, y: number, r: number }[] }} props marks: what must not be covered
 */
export const Tags = ({ labels, box, marks }) => h("div", { class: "names", "aria-hidden": true },
  placed(labels, box, marks).map(({ key, text, left, top, width, kind }) => h("span", {
    key, class: `name ${kind ?? ""}`, style: { transform: `translate(${left}px, ${top}px)`, width: `${width}px`, height: `${LINE}px` },
  }, text)));
