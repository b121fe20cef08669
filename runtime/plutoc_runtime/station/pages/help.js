// The page Help: instructions in short, and the keys. What the app's graph does not have is not
// spoken of.

import { h } from "./dom.js";

const key = (text) => h("kbd", { class: "key" }, text);

function part(title, ...content) {
  return h("section", { class: "card stack" }, h("h2", {}, title), ...content);
}

function steps(...texts) {
  return h("ol", { class: "help-steps" }, texts.map((text) => h("li", {}, text)));
}

function terms(...rows) {
  return h("dl", { class: "help-terms" }, rows.filter(Boolean)
    .map(([term, meaning]) => [h("dt", {}, term), h("dd", {}, meaning)]));
}

function keys(...rows) {
  return h("table", { class: "table" },
    h("thead", {}, h("tr", {},
      h("th", { scope: "col" }, "Key"), h("th", { scope: "col" }, "What it does"))),
    h("tbody", {}, rows.map(([names, does]) => h("tr", {},
      h("td", { class: "help-keys" }, names.map((name) => [key(name), " "])),
      h("td", {}, does)))));
}

const small = (...text) => h("p", { class: "hint" }, ...text);

const flight = (link) => part("From a plan to a flight",
  steps(
    ["On the page ", link("missions", "Missions"), ", add a mission and give it a name. "
      + "Missions fly side by side, as far as there are drones; the trips of one, one by one."],
    ["Select the mission, then press Set trips. On the page ", link("trips", "Trips"),
      ", drag actions from the list onto the map, in the order in which they are to be done. "
      + "Pins can be dragged to another place."],
    ["Press Start. The page ", link("monitor", "Monitor"), " shows each mission, each drone, "
      + "and what was measured and photographed."],
    "Missions that you add while others fly are started by pressing Start again."),
  small("Nothing flies before somebody presses Start, and nothing is lost when you close this "
    + "page: the missions fly on, and whoever opens the station sees the same."));

const stopping = () => part("Stopping",
  terms(
    ["Stop: fly home", "All drones fly back to where they started, and land there."],
    ["Stop: land now", "All drones land where they are. You may press it after the other, too."],
    ["Resume", "Every mission goes on where it was stopped."],
    ["Put away", "What was stopped is not flown any more. "
      + "Its plan stays, and can be started afresh."]),
  small("Both Stops act at once, from every page, and keep trying when the connection is lost. "
    + "A single mission is paused or cancelled on the page Monitor."));

const words = ({ retries, rounds }) => part("What the page tells you",
  terms(
    ["live", "You see what happens now. Otherwise it says how old what you see is."],
    ["To do", "The mission has no trips yet."],
    ["To mend", "It could not be flown so. Select it: it says what is wrong, and where."],
    ["Started", "The mission flies, and can be changed again when the flight is over."],
    retries && ["Attempt", "How often a trip was tried: this app tries failed ones again."],
    rounds && ["Round", "How often the mission was flown: this app can repeat missions."]));

const keyboard = () => part("Keys",
  keys(
    [["Tab", "Shift Tab"], "Go on to the next field or button, or back"],
    [["←", "→"], "On the tabs: another page"],
    [["↑", "↓"], "In the list of missions: select another"],
    [["Alt ↑", "Alt ↓"], "Move the mission or trip up or down in its list"],
    [["Enter"], "In the list of missions: set the trips"],
    [["F2"], "In the list of missions: change the name"],
    [["Delete"], "Delete the selected mission or trip; Undo brings it back"],
    [["←", "↑", "→", "↓"], "On a pin: move it by 0.1 m, with Shift by 1 m. "
      + "On the map: move the view"]));

export function help(context) {
  const link = (page, text) => h("a", {
    href: `#${page}`, onclick: (event) => { event.preventDefault(); context.go(page); },
  }, text);
  const element = h("div", { class: "help" },
    flight(link), stopping(), words(context.app), keyboard());
  return { element };
}
