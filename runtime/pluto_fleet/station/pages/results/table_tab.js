// All results as a table that is searched, filtered and sorted. Of thousands of rows those are drawn
// that are seen.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { language, plain, t } from "../core/i18n.js";
import { Button, Empty, Icon, Input, Select } from "../ui/parts.js";
import { ALL, choices, COLUMNS, windowOf } from "./table_model.js";
import { drainedWords } from "./words.js";

/** @import { Filters, Row } from "./table_model.js" */

const ROW = 40; // pixels

/** @param {{ model: ResultsModel, onPick: (row: Row) => void }} props */
export function TableTab({ model, onPick }) {
  const rows = model.rows.value;
  if (!rows.length) return null;
  const listed = model.listed.value;
  return h("div", { class: "results-table-tab" },
    h(FilterBar, { model, rows }),
    h("p", { class: "hint row", role: "status" }, t("results.listed", { n: listed.length, all: rows.length }),
      model.filters.value !== ALL && h("button", {
        type: "button", class: "link", onClick: () => { model.filters.value = ALL; },
      }, t("results.filter.none"))),
    listed.length ? h(Table, { model, listed, onPick }) : h(Empty, null, t("results.filter.empty")));
}

/** @param {{ model: ResultsModel, rows: Row[] }} props */
function FilterBar({ model, rows }) {
  /** @param {(row: Row) => readonly (string | null)[]} of */
  const among = (of) => choices(rows, of, language.value);
  return h("div", { class: "filters", role: "search" },
    h(Input, {
      type: "search", "aria-label": t("results.search"), placeholder: t("results.search"),
      value: model.filters.value.text, onText: (text) => model.filter({ text }),
    }),
    h(Choice, { model, name: "mission", all: among(({ result }) => [result.mission]) }),
    h(Choice, { model, name: "what", all: among(({ words }) => [words.what]) }),
    h(Choice, { model, name: "tag", all: among(({ result }) => result.tags) }),
    h(Choice, { model, name: "place", all: among(({ result }) => [result.place]) }));
}

/** A filter that has something to choose among. @param {{ model: ResultsModel, name: Exclude<keyof Filters, "text">, all: string[] }} props */
function Choice({ model, name, all }) {
  const value = model.filters.value[name];
  if (all.length < 2 && !value) return null;
  const options = all.map((one) => [one, name === "tag" ? plain(one) : one]);
  const label = t(`results.filter.${name}`);
  return h(Select, { "aria-label": label, value, options: [["", label], ...options], onPick: (picked) => model.filter({ [name]: picked }) });
}

/** @param {{ model: ResultsModel, listed: Row[], onPick: (row: Row) => void }} props */
function Table({ model, listed, onPick }) {
  const body = useRef(/** @type {HTMLDivElement | null} */ (null));
  const [seen, setSeen] = useState({ top: 0, height: 600 });
  useEffect(() => {
    const element = /** @type {HTMLDivElement} */ (body.current);
    const look = () => setSeen({ top: element.scrollTop, height: element.clientHeight });
    const measured = new ResizeObserver(look);
    measured.observe(element);
    element.addEventListener("scroll", look, { passive: true });
    return () => {
      measured.disconnect();
      element.removeEventListener("scroll", look);
    };
  }, []);
  const { first, last } = windowOf(seen.top, seen.height, ROW, listed.length);
  const chosen = model.chosen.value;

  /** Up and down to the next row, also to one that is not drawn yet. @param {KeyboardEvent} event */
  function onKeyDown(event) {
    const at = listed.findIndex(({ result }) => result.number === model.chosen.peek());
    const next = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: listed.length - 1 }[event.key];
    if (next === undefined || next < 0 || next >= listed.length) return;
    event.preventDefault();
    onPick(listed[next]);
    const element = /** @type {HTMLDivElement} */ (body.current);
    if (next * ROW < element.scrollTop) element.scrollTop = next * ROW;
    if ((next + 2) * ROW > element.scrollTop + element.clientHeight) {
      element.scrollTop = (next + 2) * ROW - element.clientHeight;
    }
  }
  return h("div", {
    class: "virtual", ref: body, role: "table", tabIndex: 0, "aria-label": t("page.results"), "aria-rowcount": listed.length + 1, onKeyDown,
  }, h(Headings, { model }),
  h("div", { role: "rowgroup", class: "virtual-rows", style: { height: `${listed.length * ROW}px` } },
    listed.slice(first, last).map((row, at) => h("div", {
      key: row.result.number, role: "row", "aria-rowindex": first + at + 2,
      class: `virtual-row ${row.result.number === chosen ? "chosen" : ""}`,
      style: { transform: `translateY(${(first + at) * ROW}px)` },
      onClick: () => onPick(row),
    }, COLUMNS.map((column) => h("span", { key: column, role: "cell", class: `cell of-${column}`, title: row.words[column] },
      column === "what" ? h("button", {
        type: "button", class: "cell-button", tabIndex: -1, "aria-current": row.result.number === chosen ? "true" : undefined,
      }, h("span", { class: "what" }, row.words.what), h(Drained, { result: row.result })) : row.words[column]))))));
}

/** A sign that its drone came home with less than its reserve. @param {{ result: Result }} props */
function Drained({ result }) {
  const words = drainedWords(result);
  return words && h("span", { class: "drained", role: "img", "aria-label": words, title: words }, h(Icon, { name: "warning", size: 14 }));
}

/** @param {{ model: ResultsModel }} props */
function Headings({ model }) {
  const { column: by, down } = model.order.value;
  return h("div", { role: "rowgroup", class: "virtual-head" }, h("div", { role: "row", "aria-rowindex": 1, class: "virtual-row" },
    COLUMNS.map((column) => h("span", {
      key: column, role: "columnheader", class: `cell of-${column}`, "aria-sort": column !== by ? "none" : down ? "descending" : "ascending",
    }, h(Button, { kind: "quiet", small: true, onClick: () => model.sortBy(column) }, [
      t(`column.${column}`), column === by && h("span", { key: "sign", "aria-hidden": true }, down ? " ↓" : " ↑")])))));
}
