// As much of Markdown as documentation here has: headings, paragraphs, lists, tables, code.

import { h, status } from "../dom.js";

const STATUSES = ["UNEXECUTED", "RUNNING", "STANDBY", "COMPLETED", "FAILED"];

export function words(text) {
  return text.split(/(`[^`]+`|\*\*[^*]+\*\*|\[[^\]]+\]\([^)]*\))/).map((part) => {
    if (part.startsWith("`")) return h("code", {}, part.slice(1, -1));
    if (part.startsWith("**")) return h("strong", {}, part.slice(2, -2));
    const link = /^\[([^\]]+)\]\(/.exec(part);
    return link ? link[1] : part;
  });
}

const cells = (line) => line.replace(/^\||\|$/g, "").split("|").map((cell) => cell.trim());

const cell = (text) => text.split(/,\s*/).every((one) => STATUSES.includes(one))
  ? text.split(/,\s*/).map((one) => [status(one), " "]) : words(text);

export function markdown(text, { skipTitle = false } = {}) {
  const root = h("div", { class: "markdown" });
  const lines = text.split("\n");
  for (let i = 0; i < lines.length;) {
    const line = lines[i];
    const take = (fits) => {
      const taken = [];
      while (i < lines.length && fits(lines[i])) taken.push(lines[i++]);
      return taken;
    };
    if (!line.trim()) {
      i += 1;
    } else if (line.startsWith("```")) {
      i += 1;
      const code = take((one) => !one.startsWith("```"));
      i += 1;
      root.append(h("pre", { tabIndex: 0 }, code.join("\n")));
    } else if (line.startsWith("#")) {
      i += 1;
      const level = /^#+/.exec(line)[0].length;
      if (!(skipTitle && level === 1)) root.append(h("h4", {}, words(line.replace(/^#+\s*/, ""))));
    } else if (line.startsWith("|")) {
      const rows = take((one) => one.startsWith("|")).filter((one) => !/^\|[\s|:-]+\|?$/.test(one));
      const [head, ...body] = rows.map(cells);
      root.append(h("table", {},
        h("thead", {}, h("tr", {}, head.map((one) => h("th", { scope: "col" }, words(one))))),
        h("tbody", {}, body.map((row) => h("tr", {}, row.map((one) => h("td", {}, cell(one))))))));
    } else if (/^\s*[-*] /.test(line)) {
      const items = take((one) => /^\s*[-*] |^\s+\S/.test(one));
      const joined = items.reduce((all, one) => {
        if (/^\s*[-*] /.test(one)) all.push(one.replace(/^\s*[-*] /, ""));
        else all[all.length - 1] += ` ${one.trim()}`;
        return all;
      }, []);
      root.append(h("ul", {}, joined.map((one) => h("li", {}, words(one)))));
    } else {
      root.append(h("p", {}, words(take((one) => one.trim() && !/^(```|#|\||\s*[-*] )/.test(one)).join(" "))));
    }
  }
  return root;
}
