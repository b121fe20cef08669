// Requests to the station. What does not go well is an Error with a sentence for the user, and the
// answer's status: 0 where there was none.

import { newKey } from "./dom.js";

const NOBODY = "The station does not answer.";
const TOKEN = "pluto-token";

export const wait = (time) => new Promise((done) => setTimeout(done, time));

export const token = () => sessionStorage.getItem(TOKEN) ?? "";
export const keepToken = (text) => sessionStorage.setItem(TOKEN, text.trim());

// The token moves out of the page's address at once.
export function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given === null) return;
  keepToken(given);
  history.replaceState(null, "", location.pathname);
}

const trouble = (message, status) => Object.assign(new Error(message), { status });

async function request(method, path, body, type = "application/json", timeout = 8000) {
  const headers = { "X-Pluto": "1" };
  if (token()) headers.Authorization = `Bearer ${token()}`;
  if (body !== undefined) headers["Content-Type"] = type;
  let answer;
  try {
    const signal = AbortSignal.timeout(timeout);
    answer = await fetch(path, { method, headers, body, signal, cache: "no-store" });
  } catch {
    throw trouble(NOBODY, 0);
  }
  if (answer.ok || answer.status === 409) return answer; // 409 says how things stand
  const { said } = await answer.json().catch(() => ({}));
  throw trouble(said ?? NOBODY, answer.status);
}

export async function send(method, path, content, type, timeout) {
  const body = typeof content === "string" ? content : JSON.stringify(content);
  const answer = await request(method, path, body, type, timeout);
  const data = await answer.json().catch(() => { throw trouble(NOBODY, 0); });
  return { status: answer.status, data };
}

export const get = async (path, timeout) =>
  (await send("GET", path, undefined, undefined, timeout)).data;

// → what the station says. Where the answer got lost, it is sent again with the same id, so that it
// is done once; for `patience` ms, as nothing asked for long ago is to happen out of the blue.
export async function command(name, given = {}, patience = 4000) {
  const content = { id: newKey(), ...given };
  const until = performance.now() + patience;
  for (;;) {
    try {
      const { status, data } = await send("POST", `/api/${name}`, content, undefined, 4000);
      if (status === 409) throw trouble(data.said, 409);
      return data.said;
    } catch (error) {
      if (error.status || performance.now() > until) throw error;
    }
    await wait(400);
  }
}

export async function download(path, name) {
  const answer = await request("GET", path, undefined, undefined, 30000);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await answer.blob());
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
