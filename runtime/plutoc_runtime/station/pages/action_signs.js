// What actions are called on the screen, and a sign for each; those of the app's own have a star.

import { svg } from "./dom.js";
import { plain } from "./dom.js";

const SIGNS = {
  take_photo: "M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 110 7 3.5 3.5 0 010-7z",
  measure: "M10 4.5a2 2 0 014 0v9.2a4 4 0 11-4 0zM12 9v7.5",
  pick_item: "M5 15v5h14v-5M12 15V4M7.5 8.5L12 4l4.5 4.5",
  release_item: "M5 15v5h14v-5M12 4v11M7.5 10.5L12 15l4.5-4.5",
};
const OWN = "M12 4l2.3 5.2 5.7.6-4.2 3.9 1.2 5.6-5-2.9-5 2.9 1.2-5.6L4 9.8l5.7-.6z";

/** "take_photo" is "Take photo". */
export const called = (name) => plain(name).replace(/^./, (first) => first.toUpperCase());

export const actionSign = (name) => svg("svg", { class: "action-sign", viewBox: "0 0 24 24",
  width: 20, height: 20, "aria-hidden": "true" }, svg("path", { d: SIGNS[name] ?? OWN }));
