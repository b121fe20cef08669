// Requests to the station. What does not go well is a StationError with a sentence for the user.

import { signal } from "@preact/signals";
import { newKey } from "./changes.js";
import { t } from "./i18n.js";

const TOKEN = "pluto-token";
const RETRY_EVERY = 400; // ms

/** A request that failed: `status` is the answer's, or 0 where there was none. */
export class StationError extends Error {
  /** @param {string} message @param {number} status @param {boolean} [isSaid] the sentence is the station's own */
  constructor(message, status, isSaid = status > 0) {
    super(message);
    this.status = status;
    this.isSaid = isSaid;
  }
}

/** What went wrong at the station; what went wrong here is thrown on. @param {unknown} error */
export function ofStation(error) {
  if (error instanceof StationError) return error;
  throw error;
}

/** @param {number} time milliseconds */
export const pause = (time) => new Promise((done) => { setTimeout(done, time); });

// In local storage and in no cookie: a cookie would go to every port of this machine.
/** The station's token; empty: none is known. */
export const token = signal(localStorage.getItem(TOKEN) ?? "");
window.addEventListener("storage", ({ key, newValue }) => {
  if (key === TOKEN && newValue === null) location.reload();
});

/** @param {string} text the token, or the address with it */
export function keepToken(text) {
  token.value = text.trim().replace(/^.*#token=/, "");
  localStorage.setItem(TOKEN, token.value);
}

export const forgetToken = () => localStorage.removeItem(TOKEN);

/** Take the token out of the page's address, where it would be seen and copied. */
export function takeTokenFromAddress() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given === null) return;
  keepToken(given);
  history.replaceState(null, "", location.pathname);
}

/** Who presses the buttons, for the station's records. */
export const who = signal("");

/** @param {string} method @param {string} path @param {{ body?: BodyInit, type?: string, timeout?: number }} [given] */
async function request(method, path, { body, type = "application/json", timeout = 8000 } = {}) {
  /** @type {Record<string, string>} */
  const headers = { "X-Pluto": "1" };
  if (token.value) headers.Authorization = `Bearer ${token.value}`;
  if (who.value) headers["X-Pluto-Who"] = encodeURIComponent(who.value);
  if (body !== undefined) headers["Content-Type"] = type;
  const signalled = AbortSignal.timeout(timeout);
  /** @type {Response} */
  let answer;
  try {
    answer = await fetch(path, { method, headers, body, signal: signalled, cache: "no-store" });
  } catch {
    throw new StationError(t("api.silent"), 0);
  }
  if (answer.ok || answer.status === 409) return answer; // 409 says how things stand
  const { said } = await answer.json().catch(() => ({}));
  throw new StationError(said ?? t("api.silent"), answer.status, said !== undefined);
}

/**
 * Send something, and return the answer with its status: 200, or 409 for a conflict.
 * @param {string} method @param {string} path
 * @param {unknown} [content] an object as JSON, or a text or file as it is
 * @param {{ type?: string, timeout?: number }} [options]
 * @returns {Promise<{ status: number, data: any }>}
 */
export async function send(method, path, content, options) {
  const asIs = content === undefined || typeof content === "string" || content instanceof Blob;
  const body = asIs ? content : JSON.stringify(content);
  const answer = await request(method, path, { ...options, body });
  const data = await answer.json().catch(() => { throw new StationError(t("api.silent"), 0); });
  return { status: answer.status, data };
}

/** @param {string} path @param {number} [timeout] ms @returns {Promise<any>} */
export const get = async (path, timeout) => (await send("GET", path, undefined, { timeout })).data;

/**
 * Command the station, and return what it says. Where the answer got lost the command is sent again
 * with the same id, so that it is done once; for `patience` ms, as nothing asked for long ago may
 * happen out of the blue.
 * @param {string} name @param {Record<string, unknown>} [given] @param {number} [patience]
 * @returns {Promise<string>}
 */
export async function command(name, given = {}, patience = 4000) {
  const content = { id: newKey(), ...given };
  const until = performance.now() + patience;
  for (;;) {
    try {
      const { status, data } = await send("POST", `/api/${name}`, content, { timeout: 4000 });
      if (status === 409) throw new StationError(data.said, 409);
      return data.said;
    } catch (error) {
      if (!(error instanceof StationError) || error.status || performance.now() > until) throw error;
    }
    await pause(RETRY_EVERY);
  }
}

/** @param {string} path */
export async function fetchFile(path) {
  return (await request("GET", path, { timeout: 30000 })).blob();
}

/** Let the browser save what the station has at an address. @param {string} path @param {string} name */
export async function download(path, name) {
  const address = URL.createObjectURL(await fetchFile(path));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
