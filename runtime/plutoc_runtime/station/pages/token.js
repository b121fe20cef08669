// The token of a station that listens on another address than this machine's own: it comes in the
// page's address, moves out of sight at once, and is kept as long as this tab is open.

const NAME = "pluto-token";

export function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given === null) return;
  keepToken(given);
  history.replaceState(null, "", location.pathname);
}

export function keepToken(token) {
  sessionStorage.setItem(NAME, token.trim());
}

export function token() {
  return sessionStorage.getItem(NAME) ?? "";
}
