// The report of a flight, to be read and printed: what came of each mission, its results, with the map of them,
// what went wrong, the batteries, and who commanded what.

import { h } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { capital, clock, dated, duration, inWords, moment, number, percent, plain, t, tOr } from "../core/i18n.js";
import { app } from "../core/station.js";
import { World } from "../core/world.js";
import { Camera, Seen } from "../map/camera.js";
import { Ground, Rulers } from "../map/ground.js";
import { fitting } from "../map/view.js";
import { Legend } from "../results/legend.js";
import { HeatLayers, PhotoLayer, PinLayer } from "../results/map_layers.js";
import { ResultsModel } from "../results/model.js";
import { withUnit } from "../results/words.js";
import { Button, Said } from "../ui/parts.js";
import { outcomeWords, useAsked, Waiting } from "./asked.js";
import { BatteryChart, Times } from "./battery_chart.js";

/** @param {{ flight: string }} props */
export function ReportView({ flight }) {
  const query = `?flight=${encodeURIComponent(flight)}`;
  const report = /** @type {Answer<FlightReport>} */ (useAsked(`/api/flights/report${query}`));
  const results = /** @type {Answer<Result[]>} */ (useAsked(`/api/results.json${query}`));
  const replay = /** @type {Answer<Replay>} */ (useAsked(`/api/flights/replay${query}&start=0`));
  const model = useMemo(() => {
    const world = new World();
    world.results.replace(results.data ?? []);
    return new ResultsModel(world, app.peek()?.layers ?? [], flight);
  }, [results.data, flight]);
  const trouble = report.trouble || results.trouble || replay.trouble;
  if (!report.data || !results.data || !replay.data) return h(Waiting, { trouble });
  return h(Report, { report: report.data, replay: replay.data, model });
}

/** @param {{ report: FlightReport, replay: Replay, model: ResultsModel }} props */
function Report({ report, replay, model }) {
  const shape = /** @type {AppShape} */ (app.value);
  const { flight, missions, results, drones, incidents, commands } = report;
  const marks = incidents.map(({ time, text }) => ({ time, text }));
  return h("article", { class: "report" },
    h("div", { class: "row report-head" }, h("div", null, h("p", { class: "muted" }, shape.title),
      h("h2", null, t("report.title", { when: flight.begun_at === null ? flight.id : dated(flight.begun_at) }))),
    h("div", { class: "spread no-print" }, h(Button, { kind: "primary", icon: "save", onClick: () => window.print() }, t("report.print")))),
    flight.said && h("p", { class: "problem" }, h(Said, { text: flight.said })),
    h("dl", { class: "report-facts" },
      h(Fact, { name: t("column.end"), words: t(`history.end.${flight.end}`) }),
      h(Fact, { name: t("column.missions"), words: outcomeWords(flight) }),
      h(Fact, { name: t("column.duration"), words: duration(flight.seconds) }),
      h(Fact, { name: t("column.by"), words: flight.by ?? t("unknown") }),
      h(Fact, { name: t("report.kind"), words: flight.simulated === null ? t("unknown") : t(flight.simulated ? "report.simulated" : "report.real") }),
      h(Fact, { name: t("column.trips"), words: number(flight.trips) }),
      h(Fact, { name: t("column.lost"), words: flight.lost.join(", ") || t("none") })),
    h(Part, { title: t("page.missions"), isEmpty: !missions.length }, h(Missions, { missions })),
    h(Part, { title: t("page.results"), isEmpty: !results.length }, h(ReportMap, { shape, model }), h(Results, { results })),
    replay.events.length > 0 && h(Part, { title: t("monitor.events"), isEmpty: false }, h(Events, { events: replay.events })),
    h(Part, { title: t("report.incidents"), isEmpty: !incidents.length }, h(Table, {
      title: t("report.incidents"),
      heads: [t("column.time"), t("column.mission"), t("column.drone"), t("report.what")],
      rows: incidents.map(({ time, mission, drone, text }) => [clock(time), mission ?? "", drone ?? "", h(Said, { text })]),
    })),
    h(Part, { title: t("report.batteries"), isEmpty: !drones.length },
      h("div", { class: "report-chart" }, h(BatteryChart, { batteries: replay.batteries, seconds: replay.seconds, marks }), h(Times, { seconds: replay.seconds })),
      h(Drones, { drones })),
    h(Part, { title: t("report.commands"), isEmpty: !commands.length }, h(Commands, { commands })));
}

/** @param {{ name: string, words: string }} props */
const Fact = ({ name, words }) => h("div", null, h("dt", null, name), h("dd", null, words));

/** @param {{ title: string, isEmpty: boolean, children?: ComponentChildren }} props */
const Part = ({ title, isEmpty, children }) => h("section", { class: "report-part" }, h("h3", null, title),
  isEmpty ? h("p", { class: "muted" }, t("none")) : children);

/** @param {{ title: string, heads: string[], rows: ComponentChildren[][] }} props */
const Table = ({ title, heads, rows }) => h("div", { class: "report-table", tabIndex: 0, role: "group", "aria-label": title }, h("table", { class: "table" },
  h("thead", null, h("tr", null, heads.map((head) => h("th", { key: head, scope: "col" }, head)))),
  h("tbody", null, rows.map((row, at) => h("tr", { key: at }, row.map((cell, place) => h("td", { key: place }, cell)))))));

/** @param {{ missions: ReportMission[] }} props */
const Missions = ({ missions }) => h(Table, {
  title: t("page.missions"),
  heads: [t("column.mission"), t("report.outcome"), t("report.began"), t("report.took"), t("column.trips")],
  rows: missions.map(({ name, status, why, began, ended, late, trips }) => [
    h("strong", null, name),
    [tOr(`status.${status}`, status), late && ` · ${t("monitor.late")}`, why && h("p", { class: "hint" }, h(Said, { text: why }))],
    began === null ? "" : clock(began), began === null || ended === null ? "" : duration(ended - began),
    h("ul", { class: "report-trips" }, trips.map((trip) => h("li", { key: trip.name },
      `${trip.name} (${plain(trip.action)}): ${tOr(`status.${trip.status}`, trip.status)}`,
      trip.drone && ` · ${trip.drone}`, trip.attempts > 1 && ` · ${t("report.attempts", { n: trip.attempts })}`,
      trip.why && h("span", { class: "hint" }, " · ", h(Said, { text: trip.why }))))),
  ]),
});

/** @param {{ events: EventRow[] }} props */
const Events = ({ events }) => h(Table, {
  title: t("monitor.events"),
  heads: [t("column.time"), t("event.which"), t("column.mission"), t("column.drone"), t("report.outcome")],
  rows: events.map(({ id, name, time, mission, drone, made, broke_off: broken, why }) => [
    clock(time), [h("strong", null, capital(name)), ` ${id}`], mission ?? "", drone ?? "",
    [
      made.length > 0 && h("p", null, `${t("event.made")} ${made.join(", ")}`),
      broken.length > 0 && h("p", null, `${t("event.broke-off")} ${broken.join(", ")}`), why && h("p", { class: "hint" }, h(Said, { text: why })),
    ],
  ]),
});

/** @param {{ results: ReportResults[] }} props */
const Results = ({ results }) => h(Table, {
  title: t("page.results"),
  heads: [t("column.what"), t("report.count"), t("report.lowest"), t("report.mean"), t("report.highest")],
  rows: results.map(({ action, kind, quantity, unit, count, lowest, mean, highest }) => [
    kind === "verdict" ? t("results.verdict") : capital(quantity ?? action ?? kind), number(count),
    ...[lowest, mean, highest].map((value) => (value === null ? "" : withUnit(value, unit))),
  ]),
});

/** @param {{ drones: ReportDrone[] }} props */
const Drones = ({ drones }) => h(Table, {
  title: t("report.batteries"),
  heads: [t("column.drone"), t("column.trips"), t("status.ALOFT"), t("report.battery-first"), t("report.lowest"), t("report.battery-last"), t("column.lost")],
  rows: drones.map((drone) => [
    drone.id, number(drone.trips), drone.hours === null ? t("unknown.short") : duration(drone.hours * 3600),
    percent(drone.first_battery), percent(drone.lowest_battery), percent(drone.last_battery), number(drone.lost),
  ]),
});

/** @param {{ commands: ReportCommand[] }} props */
const Commands = ({ commands }) => h(Table, {
  title: t("report.commands"),
  heads: [t("column.time"), t("report.command"), t("column.by"), t("report.said")],
  rows: commands.map(({ time, at, command, given, by, client, said }) => [
    time !== null ? clock(time) : at !== null ? moment(at) : "",
    [capital(command), ...Object.entries(given).filter(([name, value]) => value !== null && name !== "revision")
      .map(([name, value]) => `${plain(name)} ${inWords(/** @type {Scalar} */ (value))}`)].join(", "),
    by ?? client ?? "", h(Said, { text: said }),
  ]),
});

const WIDTH = 640; // pixels
const HIGHEST = 560;

/** @param {{ shape: AppShape, model: ResultsModel }} props */
export function ReportMap({ shape, model }) {
  const world = useRef(/** @type {SVGGElement | null} */ (null));
  const picture = useRef(/** @type {SVGSVGElement | null} */ (null));
  const { size } = shape.map;
  const height = Math.min(HIGHEST, Math.round((WIDTH - 56) * (size[1] / size[0])) + 62);
  const camera = useMemo(() => {
    const still = new Camera(size);
    still.resize(WIDTH, height);
    return still;
  }, [size, height]);
  useEffect(() => {
    const { left, bottom, scale } = camera.view.peek();
    world.current?.setAttribute("transform", `matrix(${scale} 0 0 ${-scale} ${left} ${bottom})`);
    picture.current?.style.setProperty("--metre", String(1 / fitting({ width: WIDTH, height }, size)));
  }, [camera, height, size]);
  return h(Seen.Provider, { value: camera }, h("figure", { class: "report-map" },
    h("div", { class: "floor" }, h("svg", { ref: picture, class: "floor-picture", viewBox: `0 0 ${WIDTH} ${height}`, "aria-hidden": true },
      h("g", { ref: world }, h(Ground, { map: shape.map }), h(HeatLayers, { model, size }), h(PhotoLayer, { model }), h(PinLayer, { model })),
      h(Rulers, { map: shape.map }))),
    h(Legend, { model })));
}
