// Quantities as people write them: "3 min", "40 mg". Inside, everything is SI.
//
//   amount("3 min") → { number: 3, unit: "min" }, or null     written(180, ["s", "min"]) → "3 min"
//   toSi("3 min") → 180, or null

const FACTORS = {
  ms: 0.001, s: 1, min: 60, h: 3600, mm: 0.001, cm: 0.01, m: 1, km: 1000, mg: 1e-6, g: 0.001, kg: 1,
  deg: Math.PI / 180, rad: 1, "%": 0.01, "m/s": 1, "km/h": 1 / 3.6, C: 1, K: 1,
};
const OFFSETS = { C: 273.15 };
const FORM = /^\s*([+-]?\d+(?:[.,]\d+)?)\s*([A-Za-z%]+(?:\/[A-Za-z]+)?)?\s*$/;

export const TIME = ["s", "min", "h"];

export function amount(text) {
  const found = FORM.exec(String(text));
  if (!found || (found[2] && !(found[2] in FACTORS))) return null;
  return { number: Number(found[1].replace(",", ".")), unit: found[2] ?? "" };
}

export function toSi(value) {
  if (typeof value === "number") return value;
  const read = amount(value);
  if (!read) return null;
  return read.number * (FACTORS[read.unit] ?? 1) + (OFFSETS[read.unit] ?? 0);
}

// In the largest unit in which it is 1 or more, to the digits that matter.
export function written(si, units) {
  const of = (unit) => (si - (OFFSETS[unit] ?? 0)) / FACTORS[unit];
  const fitting = units.filter((unit) => Math.abs(of(unit)) >= 1);
  const best = (fitting.length ? fitting : units)
    .reduce((a, b) => (FACTORS[b] > FACTORS[a] === fitting.length > 0 ? b : a));
  return `${Number(of(best).toPrecision(6))} ${best}`;
}

// A field's or parameter's value in words, as it may stand in the plan.
export function inWords(value, units = []) {
  if (typeof value !== "number" || !units.length) return String(value);
  return written(value, units);
}
