// The line to the station: a WebSocket, or plain requests where that does not work; when it breaks,
// it is tried again, at the latest every 2 s. A hidden tab asks once a second.
//
//   const line = connection(wanted, take, denied);
//       // wanted() → what to ask for; take(message); denied(): the station wants its token
//   line.start();

import { get } from "./api.js";
import { token } from "./token.js";

const SILENCE = 4000; // the station answers after a second at the latest
const POLLS = 30; // so many plain requests before the WebSocket is tried again

const NO_TOKEN = 4401;

const wait = (time) => new Promise((done) => setTimeout(done, time));

// Until the page is looked at again, a second at most.
function leisure() {
  if (!document.hidden) return Promise.resolve();
  return Promise.race([
    wait(1000),
    new Promise((done) => {
      document.addEventListener("visibilitychange", done, { once: true });
    }),
  ]);
}

// Resolves when the socket is gone, with how many messages came through it.
function throughSocket(wanted, take, denied) {
  return new Promise((done) => {
    let count = 0;
    let alarm = 0;
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/api/live`);
    const over = () => {
      clearTimeout(alarm);
      socket.onclose = socket.onmessage = socket.onerror = socket.onopen = null;
      socket.close();
      done(count);
    };
    const ask = (more) => {
      clearTimeout(alarm);
      alarm = setTimeout(over, SILENCE);
      socket.send(JSON.stringify({ ...more, ...wanted() }));
    };
    alarm = setTimeout(over, SILENCE);
    socket.onerror = over;
    socket.onclose = (event) => {
      if (event.code === NO_TOKEN) denied();
      over();
    };
    socket.onopen = () => ask(token() ? { token: token() } : {});
    socket.onmessage = async (event) => {
      clearTimeout(alarm);
      count += 1;
      try {
        take(JSON.parse(event.data));
      } catch (error) {
        console.error(error);
        over();
        return;
      }
      await leisure();
      if (socket.readyState === WebSocket.OPEN) ask();
    };
  });
}

async function byRequests(wanted, take, denied) {
  let count = 0;
  try {
    while (count < POLLS) {
      take(await get(`/api/live?${new URLSearchParams(wanted())}`, SILENCE));
      count += 1;
      await leisure();
      await wait(80);
    }
  } catch (error) {
    if (error.status === 401) denied();
    if (error.status === undefined) console.error(error);
  }
  return count;
}

export function connection(wanted, take, denied) {
  async function keepOn() {
    let failed = 0;
    for (;;) {
      const requests = failed % 3 === 2;
      const count = await (requests ? byRequests : throughSocket)(wanted, take, denied);
      if (requests && count === POLLS) failed = 1; // it works; one try of the WebSocket
      else failed = count ? 0 : failed + 1;
      await wait(count ? 50 : Math.min(2000, 150 * 2 ** Math.min(failed, 4)));
    }
  }
  return { start: keepOn };
}
