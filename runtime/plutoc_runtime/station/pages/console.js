// What happens, line by line: it follows the newest, unless one reads further up.

import { clock, h, many, put, shown } from "./dom.js";

const SHOWN = 1000; // lines on the page
const TOGETHER = 50; // lines in a block of the page: those out of sight cost nothing
const KINDS = {
  "": "All lines", info: "News", good: "Good news", bad: "Trouble", hook: "The app's own lines",
};
const SIGNS = { good: "✓", bad: "!", hook: "›" };

const line = ([, time, mission, text, kind]) => h("div", { class: `log-line ${kind}` },
  h("span", { class: "when" }, clock(time)),
  h("span", { class: "what", "aria-hidden": "true" }, SIGNS[kind]),
  mission !== null && h("b", null, mission), h("span", null, text));

export function consoleView(context, save) {
  const { live } = context;
  const option = ([value, label]) => h("option", { value }, label);
  const text = h("input", {
    type: "search", class: "input", placeholder: "Find text", "aria-label": "Find text",
    oninput: rewrite,
  });
  const of = h("select", { class: "input", "aria-label": "Of which mission", onchange: rewrite },
    option(["", "All missions"]));
  const kind = h("select", { class: "input", "aria-label": "Which lines", onchange: rewrite },
    Object.entries(KINDS).map(option));
  const lines = h("div", {
    class: "log", role: "log", "aria-live": "off", "aria-label": "Console", tabIndex: 0,
    onscroll: () => {
      following = lines.scrollTop + lines.clientHeight >= lines.scrollHeight - 8;
      if (following) unread = 0;
      shown(newest, unread);
    },
  });
  const newest = h("button", {
    class: "button small newest", hidden: true, onclick: () => {
      following = true;
      follow();
      lines.focus();
    },
  });
  const missions = new Set();
  let following = true;
  let unread = 0;
  let block = null;

  const fits = ([, , mission, said, sort]) => (!of.value || mission === of.value)
    && (!kind.value || sort === kind.value)
    && `${mission ?? ""} ${said}`.toLowerCase().includes(text.value.toLowerCase());
  function follow() {
    if (following) {
      lines.scrollTop = lines.scrollHeight;
      unread = 0;
    }
    put(newest, `${many(unread, "new line")} below`);
    shown(newest, unread);
  }
  function add(entries) {
    for (const entry of entries) {
      if (!block || block.childElementCount >= TOGETHER) {
        block = h("div", { class: "log-block" });
        lines.append(block);
      }
      block.append(line(entry));
    }
    while (lines.childElementCount > SHOWN / TOGETHER) lines.firstElementChild.remove();
    follow();
  }
  function rewrite() {
    block = null;
    following = true;
    lines.replaceChildren();
    add(live.log.filter(fits).slice(-SHOWN));
  }
  function update(entries) {
    for (const [, , mission] of entries) {
      if (mission === null || missions.has(mission)) continue;
      missions.add(mission);
      of.append(option([mission, mission]));
    }
    const fitting = entries.filter(fits).slice(-SHOWN);
    if (!following) unread += fitting.length;
    add(fitting);
  }
  function clear() {
    missions.clear();
    of.replaceChildren(of.firstElementChild);
    block = null;
    lines.replaceChildren();
  }
  new ResizeObserver(follow).observe(lines);
  return {
    tools: [text, of, kind, save("/api/console.txt")], body: [lines, newest], update, clear,
  };
}
