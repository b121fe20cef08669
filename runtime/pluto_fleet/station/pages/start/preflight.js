// The preflight of a Start: what will fly, with which drones, for how long, and what is not ready. It is asked of
// the station, anew whenever the plan has changed.

import { h } from "preact";
import { useState } from "preact/hooks";
import { send, StationError } from "../core/api.js";
import { duration, percent, say, t } from "../core/i18n.js";
import { toFly } from "../core/plan.js";
import { go } from "../core/route.js";
import { line, plan, world } from "../core/station.js";
import { useAnswer } from "../ui/hooks.js";
import { Battery, Button, Check, Chip, Dialog, HoldButton, Icon, joined, Problem, SaidWords } from "../ui/parts.js";
import { preflight, start, words } from "./commands.js";
import { counted } from "./words.js";

const LONGEST = 30000; // ms
const SETTLES = 400; // ms until a plan that is being changed is asked about
const OFTEN = 0.05; // a share of runs that is worth a word
const SHOWN = 12; // missions

/** What is expected of a Start. @param {string[] | null} missions @param {boolean} onlyFailed @returns {Promise<Forecast>} */
async function forecastOf(missions, onlyFailed) {
  await plan.saved();
  const content = { revision: plan.revision, missions, only_failed: onlyFailed };
  const { status, data } = await send("POST", "/api/preflight", content, { timeout: LONGEST });
  if (status !== 200) throw new StationError(data.said, status);
  return data;
}

/** @param {{ missions: string[] | null }} props */
export function Preflight({ missions: keys }) {
  const [onlyFailed, choose] = useState(false);
  const all = plan.missions.value;
  const missions = keys ? all.filter(({ key }) => keys.includes(key))
    : toFly(all, world.state.value.phase === "flying");
  const hasFailed = missions.some(({ ended }) => ended === "FAILED" || ended === "BROKEN_OFF");
  const again = onlyFailed && hasFailed;
  const { data: forecast, trouble } = useAnswer([all, keys, again], () => forecastOf(keys, again), { settles: SETTLES });
  const { can, said, problem } = words.value;
  const why = (!keys && !can && said) || (line.isLost.value && t("live.none")) || null;
  const given = again ? { only_failed: true } : {};
  return h(Dialog, {
    title: t("preflight.title"), class: "preflight", onClose: () => { preflight.value = null; },
    foot: [
      h(HoldButton, {
        key: "start", icon: "start", why, onHold: () => { start(keys, given); }, onPress: () => null,
      }, t("preflight.hold")),
      forecast?.rehearsal && h(Button, {
        key: "rehearse", icon: "history",
        onClick: () => {
          preflight.value = null;
          go("history", forecast.rehearsal ?? "");
        },
      }, t("preflight.rehearse")),
    ],
  },
  h("p", { class: "preflight-what" }, h("strong", null, counted(missions))),
  why && h(Problem, { text: why, isOwn: !problem || problem.isOwn }),
  hasFailed && h(Check, { checked: onlyFailed, onTick: choose }, t("preflight.only-failed")),
  h("div", { "aria-live": "polite", "aria-busy": !forecast && !trouble },
    trouble ? h(Problem, { text: trouble })
      : forecast ? h(Expected, { forecast }) : h("p", { class: "muted" }, t("preflight.computing"))));
}

/** @param {{ forecast: Forecast }} props */
const Expected = ({ forecast }) => h("div", { class: "stack" },
  h("dl", { class: "figures" },
    h(Figure, { name: t("preflight.median"), value: forecast.median === null ? t("preflight.never") : duration(forecast.median) }),
    h(Figure, { name: t("preflight.high"), value: forecast.high === null ? t("preflight.never") : duration(forecast.high) }),
    h(Figure, { name: t("preflight.lowest"), value: percent(forecast.lowest_battery) })),
  h(Sentences, { kind: "bad", all: forecast.problems }),
  h(Sentences, { kind: "warn", all: forecast.bottlenecks }),
  h(Sentences, { kind: "", all: forecast.assumed }),
  h("h3", null, t("monitor.drones")),
  h("ul", { class: "ready-list" }, forecast.drones.toSorted((a, b) => Number(a.ready) - Number(b.ready))
    .map((drone) => h(Drone, { key: drone.id, drone }))),
  h("h3", null, t("page.missions")),
  h("ul", { class: "ready-list" }, forecast.missions.slice(0, SHOWN).map((mission) => h(Mission, { key: mission.key, mission }))),
  forecast.missions.length > SHOWN && h("p", { class: "hint" }, t("many.others", { n: forecast.missions.length - SHOWN })),
  h("p", { class: "hint" }, t(forecast.world === "traffic" ? "preflight.runs-traffic" : "preflight.runs-alone", { n: forecast.runs })));

/** @param {{ name: string, value: string }} props */
const Figure = ({ name, value }) => h("div", null, h("dt", null, name), h("dd", { class: "num" }, value));

/** @param {{ kind: string, all: Words[] }} props */
const Sentences = ({ kind, all }) => (all.length
  ? h("ul", { class: `sentences ${kind}` }, all.map((one) => h("li", { key: say(one) },
    h(Icon, { name: kind ? "warning" : "info" }), h(SaidWords, { words: one }))))
  : null);

/** @param {{ drone: Readiness }} props */
function Drone({ drone: { id, battery, ready, why, ready_in: soon, assumed } }) {
  const facts = [
    why && h(SaidWords, { words: why }), soon ? t("drone.ready-in", { time: duration(soon) }) : "",
    assumed && h(SaidWords, { words: assumed }),
  ].filter(Boolean);
  return h("li", null, h("span", { class: "called" }, id),
    h(Chip, { kind: ready ? "good" : "warn", icon: ready ? "good" : "wait" }, t(ready ? "status.FREE" : "preflight.not-ready")),
    h(Battery, { level: battery }), h("span", { class: "hint" }, joined(facts)));
}

/** @param {string} median @param {string} high */
const span = (median, high) => (median === high ? median : t("preflight.span", { median, high }));

/** @param {{ mission: MissionForecast }} props */
const Mission = ({ mission: { name, median, high, late, fails } }) => h("li", null,
  h("span", { class: "called" }, name),
  h("span", { class: "num muted" }, median === null ? t("preflight.never") : span(duration(median), duration(high ?? median))),
  late > OFTEN && h(Chip, { kind: "warn" }, t("preflight.late", { share: percent(late) })),
  fails > OFTEN && h(Chip, { kind: "bad" }, t("preflight.fails", { share: percent(fails) })));
