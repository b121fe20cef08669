// The line to the server: questions with answers, and what the server tells by itself. A line that
// breaks is made anew; what was asked meanwhile is an Error with a sentence for the user.

import { bell } from "./dom.js";

const FIRST_WAIT = 300;
const LONGEST_WAIT = 4000;

export const pushes = bell();
export const linked = bell(); // true, false

let socket = null;
let last = 0;
let wait = FIRST_WAIT;
const asked = new Map(); // id → [resolve, reject]

export class Refused extends Error {}

export function open() {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  socket = new WebSocket(`${scheme}//${location.host}/ws`);
  socket.addEventListener("message", ({ data }) => heard(JSON.parse(data)));
  socket.addEventListener("open", () => {
    wait = FIRST_WAIT;
    linked.ring(true);
  });
  socket.addEventListener("close", () => {
    for (const [, reject] of asked.values()) {
      reject(new Refused("The editor’s server does not answer. It is asked again and again."));
    }
    asked.clear();
    linked.ring(false);
    setTimeout(open, wait);
    wait = Math.min(2 * wait, LONGEST_WAIT);
  });
}

function heard(message) {
  if (message.push) return pushes.ring(message);
  const [resolve, reject] = asked.get(message.id) ?? [];
  asked.delete(message.id);
  if (message.error) reject?.(new Refused(message.error));
  else resolve?.(message);
}

export const isOpen = () => socket?.readyState === WebSocket.OPEN;

export function ask(op, data = {}) {
  return askAs(nextId(), op, data);
}

export const nextId = () => (last += 1);

// With an id that is known before: pushes that come of it name it.
export function askAs(id, op, data) {
  if (!isOpen()) return Promise.reject(new Refused("The editor’s server does not answer."));
  return new Promise((resolve, reject) => {
    asked.set(id, [resolve, reject]);
    socket.send(JSON.stringify({ id, op, ...data }));
  });
}
