// The line to the server: questions with answers, and what the server tells by itself. A line that
// breaks is made anew; what was asked meanwhile is an Error with a sentence for the user.

import { bell } from "./dom.js";

const NO_TOKEN = 4401; // with which server.py closes a line
const SILENT = "The editor’s server does not answer. It is asked again; what you do meanwhile is not kept.";
const FIRST_WAIT = 300;
const LONGEST_WAIT = 4000;

export const pushes = bell();
export const linked = bell(); // true, false
export const lost = { why: SILENT };

let socket = null;
let last = 0;
let greeted = false; // by a server that knew this page's token
let wait = FIRST_WAIT;
const asked = new Map(); // id → [resolve, reject]

export class Refused extends Error {}

export function open() {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  socket = new WebSocket(`${scheme}//${location.host}/ws`);
  socket.addEventListener("message", ({ data }) => heard(JSON.parse(data)));
  socket.addEventListener("close", ({ code }) => {
    lost.why = code === NO_TOKEN ? strange() : SILENT;
    for (const [, reject] of asked.values()) reject(new Refused(lost.why));
    asked.clear();
    linked.ring(false);
    setTimeout(open, wait);
    wait = Math.min(2 * wait, LONGEST_WAIT);
  });
}

const strange = () => (greeted ? "The editor was started again: open the address that it printed."
  : "This page does not know the editor’s token: open the address that the editor printed.");

function heard(message) {
  if (message.push === "hello") { // a line that is open may be closed at once, for want of the token
    greeted = true;
    wait = FIRST_WAIT;
    linked.ring(true);
  }
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
  if (!isOpen()) return Promise.reject(new Refused(lost.why));
  return new Promise((resolve, reject) => {
    asked.set(id, [resolve, reject]);
    socket.send(JSON.stringify({ id, op, ...data }));
  });
}
