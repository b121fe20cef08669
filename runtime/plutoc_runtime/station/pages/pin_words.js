// What a pin is called, on a plate below it; above it where there is no room below.

import { put, set, svg } from "./dom.js";

const LETTER = 7.2; // pixels, more or less: the plate is a little too wide rather than too narrow

export const pinWords = () => svg("g", { class: "pin-words" },
  svg("rect", { rx: 9, height: 20, y: -14 }), svg("text"));

export function name(words, text, { floor, target }) {
  put(words.lastChild, text);
  const width = Math.round(text.length * LETTER) + 14;
  set(words.firstChild, "width", width);
  set(words.firstChild, "x", -width / 2);
  const room = floor.picture.clientHeight - floor.toPixels(target[0], target[1]).y;
  set(words, "transform", `translate(0 ${room > 50 ? 34 : -28})`);
}
