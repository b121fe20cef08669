// Signs beside words, never instead of them: lines on a grid of 24.

import { h } from "preact";

const PATHS = {
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  start: "M8 5l11 7-11 7z",
  home: "M4 11l8-7 8 7M6 10v10h12V10",
  land: "M12 4v11M7 11l5 5 5-5M5 20h14",
  warning: "M12 4L2.5 20h19zM12 10v5M12 17.4v.3",
  bad: "M12 3a9 9 0 110 18 9 9 0 010-18zM9 9l6 6M15 9l-6 6",
  info: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 11v6M12 7v.3",
  lock: "M6 11h12v9H6zM8.5 11V8a3.5 3.5 0 017 0v3",
  good: "M12 3a9 9 0 110 18 9 9 0 010-18zM8 12l3 3 5-6",
  wait: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 7v5l3 2",
  pause: "M9 5v14M15 5v14",
  grip: "M9 6v.1M15 6v.1M9 12v.1M15 12v.1M9 18v.1M15 18v.1",
  close: "M6 6l12 12M18 6L6 18",
  bell: "M6 17V11a6 6 0 0112 0v6l2 2H4zM10 20.5a2 2 0 004 0",
  undo: "M9 7L4 12l5 5M4 12h10a6 6 0 016 6v1",
  redo: "M15 7l5 5-5 5M20 12H10a6 6 0 00-6 6v1",
  full: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  rail: "M4 5h16v14H4zM15 5v14",
  fold: "M9 6l6 6-6 6",
  back: "M15 6l-6 6 6 6",
  next: "M7 6l7 6-7 6zM17 6v12",
  previous: "M17 6l-7 6 7 6zM7 6v12",
  more: "M5 12v.1M12 12v.1M19 12v.1",
  map: "M9 4L3 7v13l6-3 6 3 6-3V4l-6 3zM9 4v13M15 7v13",
  list: "M8 6h12M8 12h12M8 18h12M4 6v.1M4 12v.1M4 18v.1",
  pin: "M12 21s7-6.5 7-12a7 7 0 00-14 0c0 5.5 7 12 7 12zM12 11.5a2.5 2.5 0 100-5 2.5 2.5 0 000 5z",
  drone: "M9 9h6v6H9zM9 9L5 5M15 9l4-4M9 15l-4 4M15 15l4 4M5 5v.1M19 5v.1M5 19v.1M19 19v.1",
  chart: "M4 20V4M4 20h16M8 16v-4M12 16V8M16 16v-6",
  history: "M4 12a8 8 0 108-8 8 8 0 00-6 2.7L4 9M4 4v5h5M12 8v4l3 2",
  help: "M12 3a9 9 0 110 18 9 9 0 010-18zM9.5 9.5a2.5 2.5 0 113.5 2.300c-.7.3-1 .8-1 1.5M12 16.7v.3",
  settings: "M4 7h10M18 7h2M4 17h2M10 17h10M16 5v4M8 15v4",
  person: "M12 12a4 4 0 100-8 4 4 0 000 8zM4 21a8 8 0 0116 0",
  photo: "M4 7h4l2-3h4l2 3h4v12H4zM12 16.5a3.5 3.5 0 100-7 3.5 3.5 0 000 7z",
  save: "M12 4v11M7 11l5 5 5-5M5 20h14",
  select: "M4 8V4h4M16 4h4v4M20 16v4h-4M8 20H4v-4M9 9h6v6H9z",
  row: "M4 18.5v.1M9.500 14v.1M14.500 10v.1M20 5.500v.1",
  grid: "M5 5v.1M12 5v.1M19 5v.1M5 12v.1M12 12v.1M19 12v.1M5 19v.1M12 19v.1M19 19v.1",
  sweep: "M4 5h14v4.700H6v4.600h12v4.700H4",
  speed: "M5 5l7 7-7 7M13 5l7 7-7 7",
};
/** @typedef {keyof typeof PATHS} IconName */

/** @param {{ name: IconName, size?: number }} props */
export const Icon = ({ name, size = 18 }) => h("svg", {
  class: "icon", viewBox: "0 0 24 24", width: size, height: size, fill: "none", stroke: "currentColor",
  "stroke-width": 2, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": true,
}, h("path", { d: PATHS[name] }));
