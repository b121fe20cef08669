// One text, here and at the server: what is typed is sent in order, what others change is put in
// between. At most one message is under way; what is typed meanwhile waits.

import { Annotation, ChangeSet, Text } from "../codemirror/codemirror-state.js";
import { refused, tell } from "../announce.js";
import { askAs, isOpen, nextId } from "../link.js";
import { app } from "../state.js";

export const fromServer = Annotation.define();

const listed = (changes) => {
  const found = [];
  changes.iterChanges((from, to, _a, _b, insert) => found.push({ from, to, insert: insert.toString() }));
  return found;
};

export class Sync {
  constructor(file, view) {
    Object.assign(this, { file, view, base: Text.empty, under: null, waiting: null, id: 0, calm: [] });
  }

  // The server's whole text. What was typed and not taken yet is typed again, if it still fits.
  begin(text) {
    const own = this.under ? (this.waiting ? this.under.compose(this.waiting) : this.under) : this.waiting;
    const fits = own && this.base?.toString() === text;
    if (own && !fits && this.view.state.doc.toString() !== text) {
      tell("The text was changed elsewhere while the line was broken: the last words typed here are not in it.", { kind: "bad", stays: true });
    }
    this.under = this.waiting = null;
    this.base = Text.of(text.split("\n"));
    this.replace(text);
    if (fits) this.view.dispatch({ changes: own });
    this.rest();
  }

  replace(text) {
    const now = this.view.state.doc.toString();
    if (now === text) return;
    let start = 0;
    while (start < Math.min(now.length, text.length) && now[start] === text[start]) start += 1;
    let end = 0;
    while (end < Math.min(now.length, text.length) - start && now.at(-1 - end) === text.at(-1 - end)) end += 1;
    this.view.dispatch({
      changes: { from: start, to: now.length - end, insert: text.slice(start, text.length - end) },
      annotations: fromServer.of(true),
    });
  }

  typed(changes) {
    this.waiting = this.waiting ? this.waiting.compose(changes) : changes;
    this.send();
  }

  send() {
    if (this.under || !this.waiting || !isOpen()) return;
    this.under = this.waiting;
    this.waiting = null;
    this.id = nextId();
    const message = { changes: listed(this.under), version: app.version, file: this.file };
    askAs(this.id, "type", message).then((answer) => {
      if (answer.stale) this.lost();
    }, (error) => { if (isOpen()) refused(error); });
  }

  lost() {
    this.under = this.waiting = null;
    this.replace(this.base.toString());
    this.rest();
    tell("The same place was changed elsewhere at the same moment: that text is shown, please type yours again.", { kind: "bad", stays: true });
  }

  // A change that the server tells of: our own comes back, or another's.
  heard({ changes, by, asked }) {
    const theirs = ChangeSet.of(changes, this.base.length);
    this.base = theirs.apply(this.base);
    if (this.under && by === app.client && asked === this.id) {
      this.under = null;
      const want = this.waiting ? this.waiting.apply(this.base) : this.base;
      if (!want.eq(this.view.state.doc)) this.replace(want.toString());
      this.send();
      return this.rest();
    }
    let seen = theirs;
    if (this.under) {
      const before = this.under;
      this.under = before.map(theirs);
      seen = theirs.map(before, true);
    }
    if (this.waiting) {
      const before = this.waiting;
      this.waiting = before.map(seen);
      seen = seen.map(before, true);
    }
    this.view.dispatch({ changes: seen, annotations: fromServer.of(true) });
  }

  // When the server has all that was typed.
  atRest() {
    if (!this.under && !this.waiting) return Promise.resolve();
    return new Promise((resolve) => { this.calm.push(resolve); });
  }

  rest() {
    if (this.under || this.waiting) return;
    for (const resolve of this.calm.splice(0)) resolve();
  }
}
