// Names beside what is drawn on the map, which avoid each other: the important ones come first, and
// what has no room is left out. Those that must be seen are always there.

/** @typedef {Label & { left: number, top: number, width: number }} PlacedLabel */

export const LINE = 18; // pixels of a label's height
const LETTER = 7; // pixels of a letter, at the most of most
const PADDING = 10;
const CELL = 64; // pixels of a cell in which neighbours are looked for

/** @param {string} text */
const widthOf = (text) => [...text].length * LETTER + PADDING;

/** Where a label of a width may stand, the best first. @param {Label} label @param {number} width @returns {[number, number][]} */
function seats({ x, y, gap = 14 }, width) {
  const [middle, half] = [y - LINE / 2, x - width / 2];
  return [
    [x + gap, middle], [half, y + gap], [half, y - gap - LINE], [x - gap - width, middle],
    [x + gap * 0.7, y + gap * 0.7], [x + gap * 0.7, y - gap * 0.7 - LINE],
    [x - gap * 0.7 - width, y + gap * 0.7], [x - gap * 0.7 - width, y - gap * 0.7 - LINE],
  ];
}

/** Rectangles, found by where they are. */
class Taken {
  constructor() {
    /** @type {Map<string, [number, number, number, number][]>} */
    this.cells = new Map();
  }

  /** @param {number} left @param {number} top @param {number} width @param {number} height */
  * cellsOf(left, top, width, height) {
    for (let i = Math.floor(left / CELL); i <= Math.floor((left + width) / CELL); i += 1) {
      for (let j = Math.floor(top / CELL); j <= Math.floor((top + height) / CELL); j += 1) yield `${i} ${j}`;
    }
  }

  /** @param {number} left @param {number} top @param {number} width @param {number} height */
  add(left, top, width, height) {
    for (const cell of this.cellsOf(left, top, width, height)) {
      const all = this.cells.get(cell) ?? [];
      all.push([left, top, width, height]);
      this.cells.set(cell, all);
    }
  }

  /** @param {number} left @param {number} top @param {number} width @param {number} height */
  isFree(left, top, width, height) {
    for (const cell of this.cellsOf(left, top, width, height)) {
      for (const [x, y, w, high] of this.cells.get(cell) ?? []) {
        if (left < x + w && x < left + width && top < y + high && y < top + height) return false;
      }
    }
    return true;
  }
}

/**
 * Give labels their places in a box of pixels.
 * @param {readonly Label[]} labels
 * @param {{ width: number, height: number }} box
 * @param {readonly { x: number, y: number, r: number }[]} [marks] what must not be covered, as circles
 * @returns {PlacedLabel[]}
 */
export function placed(labels, box, marks = []) {
  const taken = new Taken();
  for (const { x, y, r } of marks) taken.add(x - r, y - r, 2 * r, 2 * r);
  const order = labels.toSorted((a, b) =>
    Number(b.always ?? false) - Number(a.always ?? false) || b.importance - a.importance);
  /** @type {PlacedLabel[]} */
  const found = [];
  for (const label of order) {
    const isSeen = label.x > 0 && label.y > 0 && label.x < box.width && label.y < box.height;
    if (!isSeen && !label.always) continue;
    const width = widthOf(label.text);
    const into = (/** @type {[number, number]} */ [left, top]) => label.always
      ? [Math.min(Math.max(left, 2), box.width - width - 2), Math.min(Math.max(top, 2), box.height - LINE - 2)]
      : [left, top];
    const all = seats(label, width).map(into);
    const seat = all.find(([left, top]) => left >= 0 && top >= 0 && left + width <= box.width
      && top + LINE <= box.height && taken.isFree(left, top, width, LINE));
    if (!seat && !label.always) continue;
    const [left, top] = seat ?? all[0];
    taken.add(left, top, width, LINE);
    found.push({ ...label, left, top, width });
  }
  return found;
}
