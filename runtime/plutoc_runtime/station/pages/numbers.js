// Metres as people write and read them.

/** A number without what nobody needs: 2.50 is "2.5". */
export const number = (value) => String(Number(value.toFixed(3)));

/** The number that somebody wrote ("2,5" too), or null. */
export function read(text) {
  const tidy = text.trim().replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(tidy) ? Number(tidy) : null;
}
