// The signs of actions: those that every app knows have their own.

import { h } from "preact";

/** @type {Record<string, string>} */
const PATHS = {
  take_photo: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
  measure: "M10 4.5a2 2 0 014 0v9.2a4 4 0 11-4 0zM12 9v7.5",
  pick_item: "M5 15v5h14v-5M12 15V4M7 9l5-5 5 5",
  release_item: "M5 15v5h14v-5M12 4v11M7 10l5 5 5-5",
};
const STAR = "M12 4l2.3 5.2 5.7.6-4.2 3.9 1.2 5.6-5-2.9-5 2.9 1.2-5.6L4 9.8l5.7-.6z";

/** @param {{ action: string }} props */
export const ActionIcon = ({ action }) => h("svg", {
  class: "icon", viewBox: "0 0 24 24", width: 18, height: 18, fill: "none", stroke: "currentColor",
  "stroke-width": 2, "stroke-linecap": "round", "stroke-linejoin": "round", "aria-hidden": true,
}, h("path", { d: PATHS[action] ?? STAR }));
