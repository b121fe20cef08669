// Signs beside words, never instead of them: icon("stop") → an <svg> that screen readers skip.

import { svg } from "./dom.js";

const PATHS = {
  plus: "M12 5v14M5 12h14",
  up: "M12 19V6M6 11l6-6 6 6",
  down: "M12 5v13M6 13l6 6 6-6",
  copy: "M9 9h10v11H9zM5 15V4h10",
  bin: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13M10 11v5M14 11v5",
  start: "M8 5l11 7-11 7z",
  pause: "M9 5v14M15 5v14",
  stop: "M6 6h12v12H6z",
  home: "M4 11l8-7 8 7M6 10v10h12V10M10 20v-6h4v6",
  land: "M12 4v11M7 11l5 5 5-5M5 20h14",
  warning: "M12 4L2.5 20h19zM12 10v5M12 17.4v.3",
  bad: "M12 3a9 9 0 110 18 9 9 0 010-18zM9 9l6 6M15 9l-6 6",
  good: "M12 3a9 9 0 110 18 9 9 0 010-18zM8 12l3 3 5-6",
  info: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 11v6M12 7v.3",
  wait: "M12 3a9 9 0 110 18 9 9 0 010-18zM12 7v5l3 2",
  lock: "M6 11h12v9H6zM8.5 11V8a3.5 3.5 0 017 0v3",
  grip: "M9 6v.1M15 6v.1M9 12v.1M15 12v.1M9 18v.1M15 18v.1",
  close: "M6 6l12 12M18 6L6 18",
  import: "M12 4v11M7 10l5 5 5-5M4 16v4h16v-4",
  export: "M12 15V4M7 9l5-5 5 5M4 16v4h16v-4",
  map: "M4 6l5-2 6 2 5-2v14l-5 2-6-2-5 2zM9 4v14M15 6v14",
  undo: "M9 7L4 11l5 4M4 11h10a5 5 0 010 10h-3",
  link: "M4 12h4l2-6 4 12 2-6h4",
  battery: "M3 8h15v8H3zM21 11v2",
  camera: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
};

export function icon(name) {
  return svg("svg", {
    viewBox: "0 0 24 24", width: 18, height: 18, fill: "none", stroke: "currentColor",
    "stroke-width": name === "grip" ? 2.6 : 1.9, "stroke-linecap": "round",
    "stroke-linejoin": "round", "aria-hidden": "true",
  }, svg("path", { d: PATHS[name] }));
}
