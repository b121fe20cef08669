// The page Help: instructions in short, and the keys.

import { h } from "./dom.js";

const part = (title, rows, hint) => h("section", { class: "card stack" }, h("h2", {}, title),
  h("dl", {}, rows.filter(Boolean).map(([term, text]) =>
    [h("dt", {}, term), h("dd", {}, text)])),
  hint && h("p", { class: "hint" }, hint));

const keys = (...names) => names.map((name) => [h("kbd", { class: "key" }, name), " "]);

export const help = ({ app }) => ({
  element: h("div", { class: "help" },
    part("From a plan to a flight", [
      ["1. Missions", "Add a mission and give it a name. Missions fly side by side, as far as there "
        + "are drones."],
      ["2. Trips", "Drag actions onto the map, in the order in which they are to be done. Pins can "
        + "be dragged to another place."],
      ["3. Start", "The page Monitor shows each mission, each drone, and what was measured and "
        + "photographed. Missions that you add meanwhile are started by pressing Start again."],
    ], "Nothing flies before somebody presses Start. When you close this page, the missions fly on; "
      + "whoever opens the station sees the same."),
    part("Stopping", [
      ["Stop: fly home", "All drones fly back to where they started, and land there."],
      ["Stop: land now", "All drones land where they are, also after the other Stop."],
      ["Resume", "Every mission goes on where it was stopped."],
      ["Put away", "What was stopped is not flown any more. Its plan stays."],
    ], "Both Stops act at once, and keep trying when the connection is lost. The page Monitor stops "
      + "a single mission."),
    part("What the page tells you", [
      ["live", "You see what happens now. Otherwise it says how old what you see is."],
      ["To do", "The mission has no trips yet."],
      ["To mend", "It could not be flown so. Select it to see what is wrong, and where."],
      ["Started", "The mission can be changed again when the flight is over."],
      app.retries && ["Attempt", "How often a trip was tried: failed ones are tried again."],
      app.rounds && ["Round", "How often the mission was flown: this app can repeat missions."],
    ]),
    part("Keys", [
      [keys("←", "→"), "On the tabs: another page"],
      [keys("↑", "↓"), "In the list of missions: select another"],
      [keys("Alt ↑", "Alt ↓"), "Move the mission or trip up or down in its list"],
      [keys("Enter", "F2"), "In the list of missions: set the trips, change the name"],
      [keys("Delete"), "Delete the mission or trip; Undo brings it back"],
      [keys("←", "↑", "→", "↓"), "On a pin: move it by 0.1 m, with Shift by 1 m. On the map: move "
        + "the view"],
    ])),
});
