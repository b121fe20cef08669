// Keys and names that are new.

/** A key that no other browser makes: 32 hexadecimal digits. */
export function newKey() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The first of "Mission 1", "Mission 2", … that is not taken. @param {string} stem @param {string[]} taken @param {number} [from] */
export function freeName(stem, taken, from = 1) {
  const names = new Set(taken.map((name) => name.trim()));
  let number = from;
  while (names.has(`${stem} ${number}`)) number += 1;
  return `${stem} ${number}`;
}
