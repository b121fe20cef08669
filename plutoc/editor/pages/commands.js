// Everything that can be done, in one table: buttons, keys and the help are made of it. What cannot
// be done now says why.

import { refused, say } from "./announce.js";
import { keysShown, pressed, set } from "./dom.js";

// { id, title, keys: ["Ctrl+Z"], where: "graph" | "page", why: () => "" or why not, run }
const table = new Map();

export const commands = () => [...table.values()];

export function define(...all) {
  for (const command of all) table.set(command.id, { where: "graph", keys: [], why: () => "", ...command });
}

export async function run(id, event) {
  const command = table.get(id);
  const why = command.why();
  if (why) return say(why);
  try {
    return await command.run(event);
  } catch (error) {
    return refused(error);
  }
}

const watched = [];

// A button of a command: greyed out, it says why, to eyes and to ears.
export function bound(element, id) {
  const command = table.get(id);
  const keys = command.keys[0] ? ` (${keysShown(command.keys[0])})` : "";
  element.addEventListener("click", (event) => run(id, event));
  element.dataset.command = id;
  if (command.keys[0]) {
    set(element, "aria-keyshortcuts", command.keys[0].replace("Ctrl", "Control"));
  }
  const refresh = () => {
    const why = command.why();
    set(element, "aria-disabled", why ? "true" : null);
    const words = why ? `${command.title}: ${why}` : `${command.title}${keys}`;
    if (element.title !== words) element.title = words;
    if (element.classList.contains("sign")) set(element, "aria-label", why ? words : command.title);
    else set(element, "aria-description", why || null);
  };
  watched.push(refresh);
  refresh();
  return element;
}

export const refreshButtons = () => watched.forEach((refresh) => refresh());

const inField = (target) => target.closest?.("input, textarea, select, [contenteditable]");

// Keys of the page count everywhere; those of the graph where no text is typed.
export function listenForKeys() {
  document.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || document.querySelector("dialog[open]")) return;
    const [target] = event.composedPath();
    const how = pressed(event);
    const command = commands().find(({ keys }) => keys.includes(how));
    if (!command) return;
    if (command.where === "graph" && (inField(target) || !target.closest?.(".viewport, .outline"))) {
      const nowhere = target === document.body && !inField(target);
      if (!nowhere) return;
    }
    if (command.where === "page" && how.length === 1 && inField(target)) return;
    event.preventDefault();
    run(command.id, event);
  });
}
