// The line to the station. The page asks for what is newer than it has seen, and gets the newest,
// once: nothing queues up. Where the WebSocket fails, plain requests are made.

import { batch, signal } from "@preact/signals";
import { get, pause, StationError, token } from "./api.js";

const SILENCE = 4000; // ms; the station answers after a second at the latest
const LOST_AFTER = 3000; // ms
const POLLS = 30; // so many plain requests before the WebSocket is tried again
const POLL_EVERY = 80; // ms
const HIDDEN_EVERY = 1000; // ms; between requests of a page that is not seen
const NO_TOKEN = 4401;

/** The line between the station and what is known here. */
export class LiveLine {
  /** @param {World} world @param {Ears} ears */
  constructor(world, ears) {
    this.world = world;
    this.ears = ears;
    this.server = signal("");
    /** Milliseconds since what is seen was made, looked at twice a second. */
    this.age = signal(Infinity);
    this.isLost = signal(false);
    /** The station's clock, in whole seconds since 1970: by it is told how long ago something was. */
    this.clock = signal(0);
    this.seen = 0;
    this.heardAt = -Infinity;
    this.lag = 0;
    this.offset = Infinity; // the station's clock against ours, by the quickest message
    setInterval(() => this.look(), 500);
  }

  look() {
    const age = performance.now() - this.heardAt + this.lag;
    batch(() => {
      this.age.value = age;
      this.isLost.value = this.heardAt > 0 && age > LOST_AFTER;
      if (this.offset < Infinity) this.clock.value = Math.floor((Date.now() - this.offset) / 1000);
    });
  }

  /** @returns {LiveRequest} */
  wanted() {
    const { flight, log, results } = this.world;
    return { flight: flight.peek(), seen: this.seen, log: log.last, results: results.last };
  }

  /** @param {LiveMessage} message */
  take(message) {
    const isOther = this.server.peek() !== "" && message.server !== this.server.peek();
    this.server.value = message.server;
    if (isOther) { // what it counts is not what the one before counted: ask for everything
      this.world.clear();
      this.seen = 0;
      this.offset = Infinity;
      this.ears.restarted();
      return;
    }
    const underWay = Date.now() - message.made_at;
    this.offset = Math.min(this.offset, underWay);
    this.lag = underWay - this.offset;
    this.heardAt = performance.now();
    this.seen = message.version;
    this.world.take(message);
    if (this.isLost.peek() || this.age.peek() === Infinity) this.look();
  }

  /** Keep the line, for as long as the page is open. */
  async keep() {
    for (let failed = 0; ;) {
      const polls = failed % 3 === 2;
      const count = await (polls ? this.poll() : this.listen());
      if (polls && count === POLLS) failed = 1; // they work; one try of the WebSocket
      else failed = count ? 0 : failed + 1;
      await pause(count ? 50 : Math.min(2000, 150 * 2 ** Math.min(failed, 4)));
    }
  }

  /** Resolves when the WebSocket is gone, with how many messages came. @returns {Promise<number>} */
  listen() {
    return new Promise((done) => {
      let count = 0;
      let alarm = 0;
      const socket = new WebSocket(`${location.origin.replace("http", "ws")}/api/live`);
      const over = () => {
        clearTimeout(alarm);
        socket.onclose = socket.onmessage = socket.onopen = null;
        socket.close();
        done(count);
      };
      const expect = () => {
        clearTimeout(alarm);
        alarm = setTimeout(over, SILENCE);
      };
      /** @param {Partial<LiveRequest>} [more] */
      const ask = (more) => {
        expect();
        socket.send(JSON.stringify({ ...more, ...this.wanted(), me: this.ears.me() }));
      };
      expect();
      socket.onopen = () => ask(token.value ? { token: token.value } : {});
      socket.onclose = ({ code }) => {
        if (code === NO_TOKEN) this.ears.denied();
        over();
      };
      socket.onmessage = async ({ data }) => {
        expect();
        count += 1;
        this.take(JSON.parse(data));
        if (document.hidden) await pause(HIDDEN_EVERY);
        if (socket.readyState === WebSocket.OPEN) ask();
      };
    });
  }

  /** @returns {Promise<number>} how many answers came */
  async poll() {
    for (let count = 0; count < POLLS; count += 1) {
      try {
        const { flight, seen, log, results } = this.wanted();
        const query = new URLSearchParams({
          flight, seen: String(seen), log: String(log), results: String(results),
        });
        this.take(await get(`/api/live?${query}`, SILENCE));
      } catch (error) {
        if (error instanceof StationError && error.status === 401) this.ears.denied();
        return count;
      }
      await pause(document.hidden ? HIDDEN_EVERY : POLL_EVERY);
    }
    return POLLS;
  }
}
