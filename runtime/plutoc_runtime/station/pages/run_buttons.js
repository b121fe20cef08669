// Start, Resume, Put away, and the two Stops, on every page. The Stops act at once and without a
// question, and they are never off while anything may fly: not when the connection is lost, either.

import { stop, tell } from "./commands.js";
import { h, put, set, shown } from "./dom.js";
import { icon } from "./icons.js";
import { inTheAir, startWords, toResume } from "./phases.js";
import { say } from "./say.js";

function button(kind, sign, text, onclick, props = {}) {
  const words = h("span", {}, text);
  const node = h("button", { class: `button ${kind}`, onclick, ...props }, icon(sign), words);
  return { node, words };
}

export function runButtons({ live, plan, go }, why) {
  let able = false;
  let starting = false;

  async function start() {
    if (starting) return;
    if (!able) {
      const reason = why();
      if (reason) say(reason);
      return;
    }
    starting = true;
    update();
    if (await plan.saved()) {
      const done = await tell("start", { revision: plan.revision() });
      await plan.load().catch(() => null);
      if (done) go("monitor");
    } else say("The plan is not saved yet, so it was not started.", { bad: true });
    starting = false;
    update();
  }

  const begin = button("primary", "start", "Start", start);
  const resume = button("primary", "start", "Resume", async () => {
    if (await tell("resume")) go("monitor");
  });
  const away = button("", "bin", "Put away", () => tell("discard").then(() => plan.load()));
  const home = button("danger", "home", "Stop: fly home", () => stop("rtl"));
  const land = button("danger", "land", "Stop: land now", () => stop("land"));
  set(begin.node, "aria-describedby", "start-why");
  const element = h("div", { class: "run", role: "group", "aria-label": "Fly" },
    begin.node, resume.node, away.node, home.node, land.node);

  function update() {
    const words = startWords(live.state, plan);
    able = words.able && !starting && !live.lost();
    put(begin.words, starting ? "Starting…" : words.text);
    set(begin.node, "aria-disabled", able ? null : "true");
    shown(begin.node, !toResume(live.state));
    shown(resume.node, toResume(live.state));
    shown(away.node, toResume(live.state));
    const off = !inTheAir(live.state) && !live.lost() && live.state.phase !== "unknown";
    home.node.disabled = land.node.disabled = off;
    return words.why;
  }
  return { element, update };
}
