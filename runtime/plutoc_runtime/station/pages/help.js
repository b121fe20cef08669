// The page Help: instructions in short, and the keys.

import { h } from "./dom.js";

const key = (text) => h("kbd", { class: "key" }, text);

function part(title, ...content) {
  return h("section", { class: "card stack" }, h("h2", {}, title), ...content);
}

function steps(...texts) {
  return h("ol", { class: "help-steps" }, texts.map((text) => h("li", {}, text)));
}

function keys(...rows) {
  return h("table", { class: "table" }, h("thead", {}, h("tr", {},
    h("th", { scope: "col" }, "Key"), h("th", { scope: "col" }, "What it does"))),
  h("tbody", {}, rows.map(([names, does]) => h("tr", {},
    h("td", { class: "help-keys" }, names.map((name) => [key(name), " "])), h("td", {}, does)))));
}

const NEVER = "Nothing flies before you press Start, and nothing is lost when you close this page: "
  + "the missions fly on, and whoever opens the station sees the same.";

export function help(context) {
  const link = (page, text) => h("a", {
    href: `#${page}`, onclick: (event) => { event.preventDefault(); context.go(page); },
  }, text);
  const { rounds, retries } = context.app;
  const element = h("div", { class: "help" },
    part("From a plan to a flight",
      steps(
        ["On the page ", link("missions", "Missions"), ", add a mission and give it a name. "
          + "Missions fly side by side, as far as there are drones; the trips of one fly one by one."],
        ["Select the mission, then press Set trips. On the page ", link("trips", "Trips"),
          ", drag actions from the list onto the map, in the order in which they are to be done. "
          + "Pins can be dragged to another place."],
        ["Press Start. The page ", link("monitor", "Monitor"), " shows each mission, each drone, "
          + "and what was measured and photographed."],
        "Missions that you add while others fly are started by pressing Start again."),
      h("p", { class: "hint" }, NEVER)),
    part("Stopping",
      h("dl", { class: "help-terms" },
        h("dt", {}, "Stop: fly home"), h("dd", {}, "All drones fly back to where they started, and land there."),
        h("dt", {}, "Stop: land now"), h("dd", {}, "All drones land where they are. You may press it after the other, too."),
        h("dt", {}, "Resume"), h("dd", {}, "Every mission goes on where it was stopped."),
        h("dt", {}, "Put away"), h("dd", {}, "What was stopped is not flown any more. Its plan stays, and can be started afresh.")),
      h("p", { class: "hint" }, "Both Stops act at once, from every page, and keep trying when the connection is lost. "
        + "A single mission is paused or cancelled on the page Monitor.")),
    part("What the page tells you",
      h("dl", { class: "help-terms" },
        h("dt", {}, "live"), h("dd", {}, "You see what happens now. Otherwise it says how old what you see is."),
        h("dt", {}, "To do"), h("dd", {}, "The mission has no trips yet."),
        h("dt", {}, "To mend"), h("dd", {}, "It could not be flown so. Select it: it says what is wrong, and where."),
        h("dt", {}, "Started"), h("dd", {}, "The mission flies, and can be changed again when the flight is over."),
        retries && h("dt", {}, "Attempt"), retries && h("dd", {}, "How often the trip was tried, as this app tries trips again that fail."),
        rounds && h("dt", {}, "Round"), rounds && h("dd", {}, "How often the mission was flown, as this app can repeat it."))),
    part("Keys",
      keys(
        [["Tab", "Shift Tab"], "Go on to the next field or button, or back"],
        [["←", "→"], "On the tabs: another page"],
        [["↑", "↓"], "In the list of missions: select another"],
        [["Alt ↑", "Alt ↓"], "Move the mission or trip up or down in its list"],
        [["Enter"], "In the list of missions: set the trips"],
        [["F2"], "In the list of missions: change the name"],
        [["Delete"], "Delete the selected mission or trip; Undo brings it back"],
        [["←", "↑", "→", "↓"], "On a pin: move it by 0.1 m, with Shift by 1 m. On the map: move the view"])));
  return { element };
}
