// The line between the graph and the text: dragged, or moved by arrow keys.

import { h, set } from "../dom.js";

const LEAST = 300;
const STEP = 24;

export function makeSplitter() {
  const splitter = h("div", {
    class: "splitter", role: "separator", tabIndex: 0, "aria-orientation": "vertical", "aria-label": "Width of the text",
    onpointerdown: (event) => splitter.setPointerCapture(event.pointerId),
    onpointermove: (event) => { if (event.buttons) width(innerWidth - event.clientX); },
    onkeydown: (event) => {
      const by = { ArrowLeft: STEP, ArrowRight: -STEP }[event.key];
      if (by) width(splitter.parentNode.getBoundingClientRect().width + by);
    },
  });
  const width = (pixels) => {
    const now = Math.round(Math.max(LEAST, Math.min(pixels, innerWidth - 560)));
    document.documentElement.style.setProperty("--side", `${now}px`);
    localStorage.setItem("pluto-side", now);
    set(splitter, "aria-valuenow", now);
    set(splitter, "aria-valuemin", LEAST);
    set(splitter, "aria-valuemax", innerWidth - 560);
  };
  const kept = Number(localStorage.getItem("pluto-side"));
  width(kept || Math.min(440, innerWidth * 0.31));
  return splitter;
}
