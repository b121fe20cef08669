// Requests to the station.
//
//   const plan = await get("/api/plan");
//   const { status, data } = await send("PUT", "/api/plan", { revision, missions });
//   const said = await command("pause", { mission: "Mission 1" });   // what the station says to it
//   await download("/api/console.txt", "console.txt");
//
// Whatever does not go well is an Error whose message is a sentence for the user. `error.status` is
// the answer's status, 0 where there was none: the station was not reached.

import { token } from "./token.js";
import { newKey } from "./words.js";

const NOBODY = "The station does not answer.";

function trouble(message, status) {
  return Object.assign(new Error(message), { status });
}

async function request(method, path, { body, type, timeout = 8000 } = {}) {
  const headers = { "X-Pluto": "1" };
  if (token()) headers.Authorization = `Bearer ${token()}`;
  if (body !== undefined) headers["Content-Type"] = type;
  try {
    const signal = AbortSignal.timeout(timeout);
    return await fetch(path, { method, headers, body, signal, cache: "no-store" });
  } catch {
    throw trouble(NOBODY, 0);
  }
}

async function read(answer) {
  try {
    return await answer.json();
  } catch {
    throw trouble(NOBODY, answer.ok ? 0 : answer.status);
  }
}

export async function get(path, timeout) {
  const answer = await request("GET", path, { timeout });
  const data = await read(answer);
  if (!answer.ok) throw trouble(data.said ?? NOBODY, answer.status);
  return data;
}

// A 409 is an answer, too: it says how things stand.
export async function send(method, path, content, type = "application/json", timeout = undefined) {
  const body = typeof content === "string" ? content : JSON.stringify(content);
  const answer = await request(method, path, { body, type, timeout });
  const data = await read(answer);
  if (!answer.ok && answer.status !== 409) {
    throw trouble(data.said ?? NOBODY, answer.status);
  }
  return { status: answer.status, data };
}

const pause = (time) => new Promise((done) => setTimeout(done, time));

// A command is sent again with the same id where its answer got lost, so it is done once.
// `patience` is how long we try, in ms: nothing asked for long ago happens out of the blue.
export async function command(name, given = {}, patience = 4000) {
  const content = { id: newKey(), ...given };
  const until = performance.now() + patience;
  for (;;) {
    try {
      const { status, data } = await send("POST", `/api/${name}`, content, undefined, 4000);
      if (status === 409) throw trouble(data.said ?? NOBODY, 409);
      return data.said;
    } catch (error) {
      if (error.status !== 0 || performance.now() > until) throw error;
    }
    await pause(400);
  }
}

export async function download(path, name) {
  const answer = await request("GET", path, { timeout: 30000 });
  if (!answer.ok) throw trouble((await read(answer)).said ?? NOBODY, answer.status);
  const url = URL.createObjectURL(await answer.blob());
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
