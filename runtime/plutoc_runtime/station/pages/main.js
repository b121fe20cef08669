// The station's page: finds out what app this is, puts the frame up, and lets the pages live in it.
// The pages are loaded one by one: whatever is wrong with one of them, Stop works.

import { get } from "./api.js";
import { tell } from "./commands.js";
import { fill, h } from "./dom.js";
import { gate } from "./gate.js";
import { liveFeed } from "./live.js";
import { planKept } from "./plan.js";
import { hush, notices, say } from "./say.js";
import { selection } from "./selection.js";
import { tabs } from "./tabs.js";
import { takeToken } from "./token.js";
import { top } from "./top.js";

const PAGES = [
  { id: "missions", title: "Missions", load: () => import("./missions.js") },
  { id: "trips", title: "Trips", load: () => import("./trips.js") },
  { id: "monitor", title: "Monitor", load: () => import("./monitor.js") },
  { id: "help", title: "Help", load: () => import("./help.js") },
];

takeToken();
const live = liveFeed();
const plan = planKept();
const context = { app: null, live, plan, say, hush, tell, selected: selection(plan), go: null };
const made = new Map(); // id of a page → the page
let open = null;
let planSaid = ""; // what is wrong with keeping the plan

const pages = tabs(PAGES, (id) => {
  open?.hide?.();
  open = made.get(id) ?? null;
  open?.show?.();
});
context.go = pages.go;
const head = top(context, pages.bar);

// Another name than the station's own is refused in words; without a token there is a place for it.
function closed({ status, message }) {
  fill(document.body, status === 401 ? gate()
    : h("main", { class: "gate" }, h("p", { class: "card" }, message)));
}

// → what the station says of the app, or null where it wants a token first.
async function described() {
  for (;;) {
    try {
      return await get("/api/app");
    } catch (error) {
      if (error.status === 401 || error.status === 403) {
        closed(error);
        return null;
      }
      say(`${error.message} Trying again.`, { bad: true });
      await new Promise((done) => setTimeout(done, 1000));
    }
  }
}

async function make({ id, title, load }) {
  try {
    const page = (await load())[id](context);
    made.set(id, page);
    pages.panel(id).append(page.element);
    if (pages.now() === id) {
      open = page;
      page.show?.();
    }
  } catch (error) {
    console.error(error);
    pages.panel(id).append(h("p", { class: "card" },
      `The page ${title} could not be shown. Load the page again; Stop works here, too.`));
  }
}

let loading = false;
async function loadPlan() {
  if (loading) return;
  loading = true;
  await plan.load().catch(() => null); // asked again as long as the revisions differ
  loading = false;
}

// The station was started again: its app may be another by now.
async function anew() {
  const { server, speed, sim, ...was } = context.app;
  const app = await described();
  if (!app) return;
  const { server: _, speed: __, sim: ___, ...is } = app;
  if (JSON.stringify(was) !== JSON.stringify(is)) location.reload();
  context.app = app;
  hush("The station was started again.");
  await loadPlan();
}

function update(changes) {
  head.update();
  const { phase, plan: revision } = live.state;
  if (revision !== undefined && revision !== plan.revision() && !plan.unsaved()) loadPlan();
  if (phase !== "unknown") open?.update?.(live, changes);
}

async function begin() {
  fill(document.body, head.element, pages.element, notices);
  const first = location.hash.slice(1);
  pages.go(PAGES.some((page) => page.id === first) ? first : "missions", true);
  context.app = await described();
  if (!context.app) return;
  live.changed.heard(update);
  live.other.heard(anew);
  live.denied.heard(() => closed({ status: 401 }));
  plan.changed.heard(() => {
    head.update();
    if (plan.said && plan.said !== planSaid) say(plan.said, { bad: true });
    planSaid = plan.said;
  });
  plan.refused.heard((said) => say(said, { bad: true }));
  window.addEventListener("beforeunload", (event) => {
    if (plan.unsaved() && plan.trouble) event.preventDefault();
  });
  live.start();
  await Promise.all([loadPlan(), ...PAGES.map(make)]);
  if (!plan.loaded) setTimeout(loadPlan, 1000);
}

begin();
