// The station's pages: the head with Start and the two Stops, and the pages, which are loaded one by
// one: though one of them is broken, Stop works.

import { signal } from "@preact/signals";
import { h, render } from "preact";
import { useErrorBoundary } from "preact/hooks";
import { alarm } from "./attention/attention.js";
import { takeTokenFromAddress } from "./core/api.js";
import { bestLanguage, speak, t } from "./core/i18n.js";
import { followMap } from "./core/landmarks.js";
import { applyLook, prefs } from "./core/prefs.js";
import { page, PAGES } from "./core/route.js";
import { app, connect, refusal, tell } from "./core/station.js";
import { Head, LostLine } from "./shell/head.js";
import { Gate, Notices, Over } from "./shell/over.js";

/** @import { ComponentType } from "preact" */
/** @import { PageName } from "./core/route.js" */

/** @type {Signal<Partial<Record<PageName, ComponentType>>>} */
const loaded = signal({});
const Broken = () => h("p", { class: "card" }, t("page-broken"));

/** @param {PageName} name */
async function load(name) {
  let component = /** @type {ComponentType} */ (Broken);
  try {
    component = (await import(`./${name === "map" ? "places" : name}/page.js`)).default;
  } catch (error) {
    console.error(error);
  }
  loaded.value = { ...loaded.value, [name]: component };
}

/** @param {{ name: PageName }} props */
function Panel({ name }) {
  const [error] = useErrorBoundary((thrown) => console.error(thrown));
  const Page = error ? Broken : loaded.value[name];
  const isOpen = page.value === name;
  return h("section", {
    class: `page ${name}-page`, role: "tabpanel", id: `page-${name}`, "aria-label": t(`page.${name}`),
    hidden: !isOpen,
  }, isOpen && Page && app.value && h(Page, null));
}

function Station() {
  if (refusal.value) return h(Gate, refusal.value);
  return h("div", { class: "station" },
    h(Head, null), h(LostLine, null),
    h("main", null, PAGES.map((name) => h(Panel, { key: name, name }))),
    h(Over, null), h(Notices, null));
}

// Without its texts the page is drawn all the same, with their keys: Stop works.
/** @param {string} chosen */
async function speakBest(chosen) {
  try {
    await speak(bestLanguage([chosen, ...navigator.languages]));
  } catch (error) {
    console.error(error);
    tell(t("api.silent"), { bad: true });
  }
}

takeTokenFromAddress();
applyLook();
connect();
await speakBest(prefs.language.peek());
render(h(Station, null), document.body);
prefs.language.subscribe(speakBest);
alarm();
followMap();
const first = page.peek(); // another one may be open once this is here
await load(first);
await Promise.all(PAGES.map((name) => name !== first && load(name)));
document.documentElement.dataset.loaded = "all"; // from here on the pages work without the station's files
