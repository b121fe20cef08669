// Numbers, times and counts as people read them.
//
//   many(3, "mission") → "3 missions"     clock(75) → "1:15"     seconds(75) → "1 min 15 s"
//   plain("take_photo") → "take photo"    newKey() → a key for a new mission or trip

export function many(n, one, more = `${one}s`) {
  return `${n} ${n === 1 ? one : more}`;
}

export function clock(seconds) {
  const all = Math.max(0, Math.floor(seconds));
  const two = (n) => String(n).padStart(2, "0");
  const [hours, minutes] = [Math.floor(all / 3600), Math.floor(all / 60) % 60];
  return hours ? `${hours}:${two(minutes)}:${two(all % 60)}` : `${minutes}:${two(all % 60)}`;
}

export function seconds(time) {
  const all = Math.max(0, Math.round(time));
  if (all < 60) return `${all} s`;
  if (all < 3600) return all % 60 ? `${Math.floor(all / 60)} min ${all % 60} s` : `${all / 60} min`;
  const minutes = Math.round(all / 60);
  return minutes % 60 ? `${Math.floor(minutes / 60)} h ${minutes % 60} min` : `${minutes / 60} h`;
}

export function plain(name) {
  return name.replaceAll("_", " ");
}

export function newKey() {
  const letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => letters[byte % letters.length]).join("");
}

// A name that none of the others has: "Mission 1", "Mission 2"; a copy of "Ward" is "Ward 2".
export function freeName(stem, names, first = 1) {
  const taken = new Set(names.map((name) => String(name).trim()));
  let n = first;
  while (taken.has(`${stem} ${n}`)) n += 1;
  return `${stem} ${n}`;
}
