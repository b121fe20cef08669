// A tour of one minute: what is where, a sentence each, with the place marked.

import { signal } from "@preact/signals";
import { h } from "preact";
import { useEffect } from "preact/hooks";
import { t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { go } from "../core/route.js";
import { Button, Dialog } from "../ui/parts.js";

/** @import { PageName } from "../core/route.js" */

const STEPS = /** @type {const} */ ([
  ["missions", "missions", "#page-missions"], ["trips", "trips", "#page-trips"],
  ["start", "trips", ".starts"], ["monitor", "monitor", "#page-monitor"],
  ["stop", "monitor", ".stops"], ["attention", "monitor", ".attention"],
  ["results", "results", "#page-results"],
]);

/** The step of the tour that is shown, from 0; null: none. */
export const touring = signal(/** @type {number | null} */ (null));

export function Tour() {
  const at = touring.value ?? 0;
  const [name, page, marked] = STEPS[at];
  useEffect(() => {
    go(/** @type {PageName} */ (page));
    const element = document.querySelector(marked);
    element?.classList.add("toured");
    return () => element?.classList.remove("toured");
  }, [page, marked]);
  const end = () => {
    touring.value = null;
    prefs.tour.value = true;
  };
  const isLast = at === STEPS.length - 1;
  return h(Dialog, {
    title: t("tour.step", { n: at + 1, all: STEPS.length, title: t(`tour.${name}`) }), class: "tour", onClose: end,
    foot: [
      at > 0 && h(Button, { key: "back", onClick: () => { touring.value = at - 1; } }, t("tour.back")),
      h(Button, {
        key: "next", kind: "primary", onClick: isLast ? end : () => { touring.value = at + 1; },
      }, t(isLast ? "tour.end" : "tour.next")),
    ],
  }, h("p", null, t(`tour.${name}-text`)));
}

/** @param {{ name: "missions" | "trips" | "start" | "stop", n?: number }} props */
export const Step = ({ name, n }) => [
  h("h3", { key: "title" }, n ? `${n}. ` : "", t(`tour.${name}`)), h("p", { key: "more", class: "muted" }, t(`tour.${name}-text`))];

/** The three steps to a flight. @param {{ class: string }} props */
export const Steps = ({ class: more }) => h("ol", { class: more },
  (/** @type {const} */ (["missions", "trips", "start"])).map((name, at) => h("li", { key: name }, h(Step, { name, n: at + 1 }))));
