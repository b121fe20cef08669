// What nobody reads ten times a second is gathered, and written four times a second.
const OFTEN = 250; // ms

// gathered(write, key) -> {add(items), clear()}: of items with the same key only the newest is
// written; without a key all of them are.
export function gathered(write, key = null) {
  let waiting = new Map();
  let count = 0;
  let timer = 0;
  const flush = () => {
    timer = 0;
    const items = [...waiting.values()];
    waiting = new Map();
    if (items.length) write(items);
  };
  const add = (items) => {
    for (const item of items) {
      count += 1;
      waiting.set(key === null ? count : item[key], item);
    }
    if (waiting.size) timer ||= setTimeout(flush, OFTEN);
  };
  return { add, clear: () => waiting.clear() };
}
