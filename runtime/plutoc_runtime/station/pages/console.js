// What happens, line by line: it follows the newest, unless one reads further up.
import { h } from "./dom.js";
import { fetched } from "./fetched.js";
import { clock, many } from "./dom.js";

const KEPT = 5000; // lines that the filters can find
const SHOWN = 1000; // lines on the page
const TOGETHER = 50; // lines in a block of the page: those out of sight cost nothing
const KINDS = [
  ["", "All lines"],
  ["info", "News"],
  ["good", "Good news"],
  ["bad", "Trouble"],
  ["hook", "The app's own lines"],
];
const SIGNS = { good: "✓", bad: "!", hook: "›" };

function line([, time, mission, text, kind]) {
  return h(
    "div",
    { class: `log-line ${kind}` },
    h("span", { class: "m-when" }, clock(time)),
    h("span", { class: "m-kind", "aria-hidden": "true" }, SIGNS[kind] ?? ""),
    mission === null ? null : h("span", { class: "m-of" }, mission),
    h("span", { class: "m-text" }, text),
  );
}

export function consoleView(context) {
  let kept = [];
  let following = true;
  let unread = 0;
  let block = null;
  const missions = new Set();
  const text = h("input", { type: "search", placeholder: "Find text", "aria-label": "Find text" });
  const mission = h("select", { "aria-label": "Of which mission" }, h("option", { value: "" }, "All missions"));
  const kind = h(
    "select",
    { "aria-label": "Which lines" },
    ...KINDS.map(([value, label]) => h("option", { value }, label)),
  );
  const save = h("button", { type: "button", class: "button quiet small" }, "Download");
  save.addEventListener("click", () => fetched(context, "/api/console.txt", "console.txt"));
  const tools = h("div", { class: "console-tools" }, text, mission, kind, save);

  const lines = h("div", {
    class: "log",
    role: "log",
    "aria-live": "off",
    "aria-label": "Console",
    tabindex: "0",
  });
  const newest = h("button", { type: "button", class: "button newest" });
  newest.hidden = true;
  newest.addEventListener("click", () => {
    lines.scrollTop = lines.scrollHeight;
    lines.focus();
  });
  const element = h("div", { class: "console-body" }, lines, newest);

  const passes = ([, , of, said, kind_]) =>
    (!mission.value || of === mission.value) &&
    (!kind.value || kind_ === kind.value) &&
    (!text.value || `${of ?? ""} ${said}`.toLowerCase().includes(text.value.toLowerCase()));
  const follow = () => {
    if (following) lines.scrollTop = lines.scrollHeight;
    newest.hidden = following || unread === 0;
    if (!newest.hidden) newest.textContent = `${many(unread, "new line")} below`;
  };
  const add = (entries) => {
    for (const entry of entries) {
      if (!block || block.childElementCount >= TOGETHER) {
        block = h("div", { class: "log-block" });
        lines.append(block);
      }
      block.append(line(entry));
    }
  };
  const rewrite = () => {
    block = null;
    lines.replaceChildren();
    add(kept.filter(passes).slice(-SHOWN));
    following = true;
    unread = 0;
    follow();
  };
  lines.addEventListener("scroll", () => {
    following = lines.scrollTop + lines.clientHeight >= lines.scrollHeight - 8;
    if (following) unread = 0;
    newest.hidden = following || unread === 0;
  });
  let typing = 0;
  text.addEventListener("input", () => {
    clearTimeout(typing);
    typing = setTimeout(rewrite, 150);
  });
  for (const each of [mission, kind]) each.addEventListener("change", rewrite);

  const update = (entries) => {
    kept.push(...entries);
    if (kept.length > KEPT * 1.2) kept = kept.slice(-KEPT);
    for (const entry of entries) {
      if (entry[2] === null || missions.has(entry[2])) continue;
      missions.add(entry[2]);
      mission.append(h("option", { value: entry[2] }, entry[2]));
    }
    const fitting = entries.filter(passes).slice(-SHOWN);
    if (!fitting.length) return;
    add(fitting);
    while (lines.childElementCount > SHOWN / TOGETHER) lines.firstElementChild.remove();
    unread = following ? 0 : unread + fitting.length;
    follow();
  };
  const clear = () => {
    kept = [];
    missions.clear();
    mission.replaceChildren(mission.firstElementChild);
    rewrite();
  };
  const resized = new ResizeObserver(() => follow());
  resized.observe(lines);
  return { element, tools, update, clear };
}
