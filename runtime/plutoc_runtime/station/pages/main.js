// The station's page: finds out what app this is, puts the frame up, and lets the pages live in it.
// They are loaded one by one: whatever is wrong with one of them, Stop works.

import { get, keepToken, liveFeed, takeToken, token, wait } from "./api.js";
import { fill, h, icon, set, shown } from "./dom.js";
import { head, hush, notices, say, tell } from "./head.js";
import { planKept, selection } from "./plan.js";

const LOAD = {
  missions: () => import("./missions.js"),
  trips: () => import("./trips.js"),
  monitor: () => import("./monitor.js"),
  help: () => import("./missions.js"),
};
const IDS = Object.keys(LOAD);
const capital = (id) => id[0].toUpperCase() + id.slice(1);

takeToken();
const live = liveFeed();
const plan = planKept();
const context = { app: {}, live, plan, say, hush, tell, selected: selection(plan), go };
const pages = new Map();
let now = "";
let said = "";

// A tab and its page for each; which one is open stands in the address after #.
const buttons = IDS.map((id) => h("button", {
  class: "tab", role: "tab", id: `tab-${id}`, "aria-controls": `page-${id}`, onclick: () => go(id),
}, capital(id)));
const panels = IDS.map((id) => h("section", {
  class: "page", role: "tabpanel", id: `page-${id}`, "aria-labelledby": `tab-${id}`,
}));
const bar = h("div", {
  class: "tabs", role: "tablist", "aria-label": "Pages",
  onkeydown(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const to = (IDS.indexOf(now) + step + IDS.length) % IDS.length;
    go(IDS[to]);
    buttons[to].focus();
  },
}, buttons);

function go(id, quiet) {
  const there = pages.get(now);
  now = IDS.includes(id) ? id : IDS[0];
  if (!quiet && location.hash !== `#${now}`) history.pushState(null, "", `#${now}`);
  IDS.forEach((other, i) => {
    set(buttons[i], "aria-selected", String(other === now));
    buttons[i].tabIndex = other === now ? 0 : -1;
    shown(panels[i], other === now);
  });
  there?.hide?.();
  pages.get(now)?.show?.();
}

const top = head(context, bar);

async function make(id, i) {
  try {
    const page = (await LOAD[id]())[id](context);
    pages.set(id, page);
    panels[i].append(page.element);
    if (now === id) page.show?.();
  } catch (error) {
    console.error(error);
    fill(panels[i], h("p", { class: "card" },
      "This page could not be shown. Load it again; Stop works here, too."));
  }
}

// Without the station's token: where to find it, and a place to put it. Any other no is shown.
function closed({ status, message }) {
  const input = h("input", { id: "token", type: "password", autocomplete: "off", required: true });
  const form = h("form", {
    class: "stack",
    onsubmit(event) {
      event.preventDefault();
      keepToken(input.value.replace(/^.*#token=/, ""));
      location.reload();
    },
  },
  h("p", {}, "It was printed where the station was started, in the line that begins with ",
    h("code", {}, "station:"), ". Open the whole address from there, or paste it here."),
  h("div", { class: "field" }, h("label", { for: "token" }, "Address or token"), input),
  token() && h("p", { class: "problem", role: "alert" }, icon("warning"),
    "The station knows no such token: it makes a new one each time it is started."),
  h("div", {}, h("button", { class: "button primary" }, "Open the station")));
  fill(document.body, h("main", { class: "gate" }, h("div", { class: "card stack" },
    h("h1", {}, status === 401 ? "This station asks for its token" : message),
    status === 401 && form)));
}

// → whether we may know what app this is
async function described() {
  for (;;) {
    try {
      Object.assign(context.app, await get("/api/app"));
      return true;
    } catch (error) {
      if (error.status === 401 || error.status === 403) {
        closed(error);
        return false;
      }
    }
    await wait(1000);
  }
}

let loading = false;
async function loadPlan() {
  if (loading) return;
  loading = true;
  await plan.load().catch(() => wait(500)); // asked again as long as the revisions differ
  loading = false;
}

// The station was started again: its app may be another by now.
async function anew() {
  const shape = () => JSON.stringify({ ...context.app, server: "", sim: "", speed: "" });
  const was = shape();
  if (!await described()) return;
  if (shape() !== was) location.reload();
  hush("The station was started again.");
  loadPlan();
}

async function begin() {
  fill(document.body, top.element, h("main", {}, panels), notices);
  go(location.hash.slice(1), true);
  window.addEventListener("popstate", () => go(location.hash.slice(1), true));
  if (!await described()) return;
  live.changed.heard((changes) => {
    top.update();
    if (live.state.plan !== plan.revision() && !plan.unsaved()) loadPlan();
    pages.get(now)?.update?.(live, changes);
  });
  live.other.heard(anew);
  live.denied.heard(() => closed({ status: 401 }));
  plan.changed.heard(() => {
    top.update();
    if (plan.said && plan.said !== said) say(plan.said, { bad: true });
    said = plan.said;
  });
  plan.refused.heard((text) => say(text, { bad: true }));
  window.addEventListener("beforeunload", (event) => plan.trouble && event.preventDefault());
  live.start();
  loadPlan();
  IDS.forEach(make);
}

begin();
