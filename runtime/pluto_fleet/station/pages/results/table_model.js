// The table of results: filtered, sorted, and of thousands of rows those that are seen. Pure.

export const COLUMNS = /** @type {const} */ (["time", "what", "value", "place", "mission", "trip", "drone"]);
/** @typedef {typeof COLUMNS[number]} Column */

/**
 * A row, as it is read and as it is sorted.
 * @typedef {object} Row
 * @property {Result} result
 * @property {Record<Column, string>} words
 * @property {string} text all of it, in small letters, to be searched
 */

/** Empty: all. @typedef {{ text: string, mission: string, what: string, tag: string, place: string }} Filters */
/** @type {Readonly<Filters>} */
export const ALL = { text: "", mission: "", what: "", tag: "", place: "" };

/** @param {Row} row @param {Filters} filters @param {string[]} words of the text that is searched */
const fits = ({ result, words: row, text }, filters, words) =>
  (!filters.mission || result.mission === filters.mission)
  && (!filters.what || row.what === filters.what)
  && (!filters.tag || result.tags.includes(filters.tag))
  && (!filters.place || result.place === filters.place)
  && words.every((word) => text.includes(word));

/** @param {readonly Row[]} rows @param {Filters} filters */
export function filtered(rows, filters) {
  const words = filters.text.toLowerCase().split(/\s+/).filter(Boolean);
  return rows.filter((row) => fits(row, filters, words));
}

/** What a row is sorted by: numbers before texts, and what is missing last. @param {Row} row @param {Column} column @returns {number | string} */
function keyOf({ result, words }, column) {
  if (column === "time") return result.time;
  const number = column === "value" ? result.values[0]?.value : undefined;
  return number ?? words[column];
}

/** @param {number | string} a @param {number | string} b @param {Intl.Collator} collator */
function compared(a, b, collator) {
  if (typeof a === "number" && typeof b === "number") return a - b;
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
  return collator.compare(String(a), String(b));
}

/** @param {readonly Row[]} rows @param {{ column: Column, down: boolean }} by @param {string} [language] */
export function sorted(rows, { column, down }, language) {
  const collator = new Intl.Collator(language, { numeric: true });
  const keyed = rows.map((row) => ({ row, key: keyOf(row, column) }));
  keyed.sort((a, b) => {
    const missing = Number(a.key === "") - Number(b.key === "");
    const order = missing || compared(a.key, b.key, collator) * (down ? -1 : 1);
    return order || a.row.result.number - b.row.result.number;
  });
  return keyed.map(({ row }) => row);
}

/** What a filter can choose among: each once, in order. @param {readonly Row[]} rows @param {(row: Row) => readonly (string | null)[]} of @param {string} [language] */
export function choices(rows, of, language) {
  const found = new Set(rows.flatMap((row) => of(row)));
  return [...found].filter((one) => one !== null && one !== "").map(String)
    .toSorted(new Intl.Collator(language, { numeric: true }).compare);
}

/**
 * Which rows of a long list are drawn.
 * @param {number} top pixels that are scrolled away @param {number} height pixels that are seen
 * @param {number} row pixels of one row @param {number} count of all rows
 */
export function windowOf(top, height, row, count, more = 8) {
  const first = Math.max(0, Math.min(Math.floor(top / row) - more, count));
  return { first, last: Math.min(count, Math.ceil((top + height) / row) + more) };
}
