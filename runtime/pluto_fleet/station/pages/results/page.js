// The results of a flight, on the page Results of the present one or the last: on the map, in layers, beside it as
// lists, and as files for other programs.

import { effect, signal } from "@preact/signals";
import { h } from "preact";
import { useEffect, useMemo } from "preact/hooks";
import { get, ofStation } from "../core/api.js";
import { clock, t } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { go } from "../core/route.js";
import { app, save, selectMission, world as live } from "../core/station.js";
import { isFlying } from "../core/world.js";
import { Camera } from "../map/camera.js";
import { Floor, MapSplit } from "../map/floor.js";
import { Landmarks, North } from "../map/ground.js";
import { Button, Empty, Tabs } from "../ui/parts.js";
import { ResultCard, revealBeside } from "./card.js";
import { placeOf } from "./layers.js";
import { LayersTab, Legend } from "./legend.js";
import { estimated, HeatLayers, MapLabels, PhotoLayer, PinLayer } from "./map_layers.js";
import { ResultsModel } from "./model.js";
import { PhotosTab, Viewer } from "./photos_tab.js";
import { TableTab } from "./table_tab.js";
import { layerWords, placeWords, valueWords, whatWords, withUnit } from "./words.js";

const PHONE = matchMedia("(max-width: 760px)");
const TABS = /** @type {const} */ (["layers", "table", "photos", "verdicts"]);
/** @typedef {typeof TABS[number]} TabName */

/**
 * What a world has brought: the flight as it is now, or one of the past.
 * @param {object} props
 * @param {World} props.world
 * @param {string | null} props.flight the id of one of the past; null: the one as it is now
 * @param {(result: Result) => void} props.onConsole show what happened then
 * @param {string} props.consoleWords what that is called
 */
export function ResultsView({ world, flight, onConsole, consoleWords }) {
  const shape = /** @type {AppShape} */ (app.value);
  const camera = useMemo(() => new Camera(shape.map.size), [shape]);
  const model = useMemo(() => new ResultsModel(world, shape.layers, flight), [world, shape, flight]);
  const tab = TABS.find((name) => name === prefs.resultsTab.value) ?? "layers";
  const isEmpty = !model.results.value.length;
  /** @param {number} number @param {boolean} [near] */
  const choose = (number, near) => {
    model.chosen.value = number;
    const place = placeOf(/** @type {Result} */ (model.find(number)));
    if (near && place) revealBeside(camera, place[0], place[1]);
  };
  return h("div", { class: `results ${tab === "table" && !isEmpty ? "wide-rail" : ""}` }, h(MapSplit, {
    stage: [
      h(Stage, { key: "stage", model, camera, choose }),
      h(Legend, { key: "legend", model }),
      isEmpty && h("div", { key: "empty", class: "stage-empty card" }, h(Why, { model, shape })),
      h(ResultCard, { key: "card", model, camera, onConsole, consoleWords }),
      h(Viewer, { key: "viewer", model }),
    ],
    rail: [
      h(Tabs, {
        key: "tabs", label: t("results.tabs"), names: TABS, now: tab,
        title: (/** @type {TabName} */ name) => t(`results.tab.${name}`),
        onPick: (/** @type {TabName} */ name) => {
          prefs.resultsTab.value = name;
          if (PHONE.matches) model.chosen.value = null; // its card lies over the list
        },
      }),
      h("div", { key: "body", class: "rail-body", role: "tabpanel", "aria-label": t(`results.tab.${tab}`), tabIndex: 0 }, {
        layers: () => h(LayersTab, { model }),
        table: () => (isEmpty ? h(Why, { model, shape })
          : h(TableTab, { model, onPick: ({ result }) => choose(result.number, true) })),
        photos: () => h(PhotosTab, { model }),
        verdicts: () => h(VerdictsTab, { model }),
      }[tab]()),
      model.isCut.value && h("p", { key: "cut", class: "hint results-cut" }, t("results.only-newest", { n: model.results.value.length })),
      h(Exports, {
        key: "exports", flight, disabled: isEmpty,
        hasPictures: model.album.value.some(({ value }) => typeof value === "object" && Boolean(value?.picture)),
      }),
    ],
  }));
}

/** Why there is nothing to see, and what will be. @param {{ model: ResultsModel, shape: AppShape }} props */
function Why({ model, shape }) {
  const { phase, known } = model.world.state.value;
  const what = !shape.layers.length ? "never" : !known ? "unknown"
    : phase === "idle" ? "idle" : isFlying(phase) ? "flying" : "over";
  return h(Empty, null, t(`results.none.${what}`));
}

/** @typedef {{ x: number, y: number, words: string } | null} Pointed in pixels */

/** @param {{ model: ResultsModel, camera: Camera, choose: (number: number) => void }} props */
function Stage({ model, camera, choose }) {
  const shape = /** @type {AppShape} */ (app.value);
  const pointed = useMemo(() => signal(/** @type {Pointed} */ (null)), []);
  /** @param {PointerEvent} event */
  function point(event) {
    const isMap = event.pointerType === "mouse" && !event.buttons && camera.picture?.contains(/** @type {Node} */ (event.target));
    const at = isMap ? camera.metres(event) : null;
    const words = at ? wordsAt(model, at, camera.view.peek().scale) : "";
    pointed.value = words ? { ...camera.inside(event), words } : null;
  }
  return h("div", { class: "results-stage", onPointerMove: point, onPointerLeave: () => { pointed.value = null; } },
    h(Floor, {
      map: shape.map, camera,
      children: [
        h(HeatLayers, { key: "heat", model, size: shape.map.size }),
        h(Landmarks, { key: "landmarks" }),
        h(PhotoLayer, { key: "photos", model }),
        h(PinLayer, { key: "pins", model }),
      ],
      overlay: [h(MapLabels, { key: "labels", model }), h(North, { key: "north" })],
      onPlace: (at) => {
        const [newest] = model.under(at, camera.view.peek().scale);
        if (newest) choose(newest.number);
        else model.chosen.value = null;
      },
    }), h(Tip, { pointed }));
}

/** What is known of the place under the pointer. @param {ResultsModel} model @param {At} at @param {number} scale */
function wordsAt(model, at, scale) {
  const [newest, ...earlier] = model.under(at, scale);
  if (newest) {
    const words = [whatWords(newest), valueWords(newest), placeWords(newest)].filter(Boolean).join(" · ");
    return earlier.length ? t("results.and-earlier", { words, n: earlier.length }) : words;
  }
  const guess = estimated(model.shown.peek(), at.x, at.y);
  return guess ? t("results.estimated", { what: layerWords(guess.layer), value: withUnit(guess.value, guess.layer.unit) }) : "";
}

/** @param {{ pointed: Signal<Pointed> }} props */
function Tip({ pointed }) {
  const at = pointed.value;
  return at && h("div", { class: "tip", "aria-hidden": true, style: { transform: `translate(${at.x + 14}px, ${at.y + 14}px)` } }, at.words);
}

/** @param {{ model: ResultsModel }} props */
export function VerdictsTab({ model }) {
  const verdicts = model.results.value.filter(({ kind }) => kind === "verdict").toReversed();
  if (!verdicts.length) return h(Empty, null, t("results.none.verdicts"));
  return h("ul", { class: "verdicts" }, verdicts.map(({ number, time, mission, value }) =>
    h("li", { key: number }, h("p", { class: "row" }, h("strong", null, mission), h("span", { class: "muted num" }, clock(time))),
      h("p", { class: "user-text" }, String(value)))));
}

const KINDS = /** @type {const} */ (["csv", "geojson", "zip", "json"]);

/** @param {{ flight: string | null, hasPictures: boolean, disabled?: boolean }} props flight: null is the one as it is now */
export function Exports({ flight, hasPictures, disabled }) {
  const query = flight === null ? "" : `?flight=${encodeURIComponent(flight)}`;
  const stem = flight === null ? "results" : `results-${flight}`;
  return h("div", { class: "exports row", role: "group", "aria-label": t("results.export") },
    h("span", { class: "muted hint" }, t("results.export")),
    KINDS.filter((kind) => kind !== "zip" || hasPictures).map((kind) => h(Button, {
      key: kind, small: true, kind: "quiet", icon: "save", disabled, onClick: () => { save(`/api/results.${kind}${query}`, `${stem}.${kind}`); },
    }, t(`results.export.${kind}`))));
}

const PATIENCE = 30000; // ms

/** @param {Result} result */
function showInConsole({ mission }) {
  selectMission(mission);
  prefs.railTab.value = "log";
  prefs.rail.value = true;
  go("monitor");
}

/** All results of the flight as it is now: live messages bring only the newest to a page that came late. */
function useWhole() {
  useEffect(() => {
    let asked = ""; // the flight and its last result when it was asked for: else a loss would be asked for for ever
    return effect(() => {
      const { results, flight } = live;
      const now = `${flight.value} ${results.last}`;
      if (results.isWhole || now === asked) return;
      asked = now;
      get("/api/results.json", PATIENCE).then((all) => {
        if (now.startsWith(`${flight.peek()} `)) results.fill(all);
      }, ofStation); // the next result asks again
    });
  }, []);
}

export default function Results() {
  useWhole();
  return h(ResultsView, { world: live, flight: null, onConsole: showInConsole, consoleWords: t("results.show-in-console") });
}
