// What a view of results shows: of the flight as it is now, of one of the past, or of a replay.

import { computed, signal } from "@preact/signals";
import { language } from "../core/i18n.js";
import { prefs } from "../core/prefs.js";
import { LINES_KEPT } from "../core/world.js";
import { countsOf, hit, layersOn, photosOf, pinsOf, shownLayers, spotsOf } from "./layers.js";
import { ALL, filtered, sorted } from "./table_model.js";
import { rowOf } from "./words.js";

/** @import { Column, Filters } from "./table_model.js" */

export class ResultsModel {
  /** @param {World} world @param {readonly Layer[]} layers of the app @param {string | null} flight null: the flight as it is now */
  constructor(world, layers, flight) {
    this.world = world;
    this.flight = flight;
    this.results = world.results.entries;
    /** Whether there were more than a page keeps. */
    this.isCut = computed(() => this.results.value.length >= LINES_KEPT && this.results.value[0].number > 1);
    this.layers = computed(() => shownLayers(layers, this.results.value));
    this.on = computed(() => layersOn(this.layers.value, prefs.layers.value));
    this.shown = computed(() => this.layers.value.filter(({ id }) => this.on.value.has(id)));
    this.photos = computed(() => photosOf(this.of("photos")));
    this.pins = computed(() => pinsOf(this.of("findings")));
    this.counts = computed(() => countsOf(this.pins.value));
    this.values = computed(() => this.numbers().flatMap(({ results }) => spotsOf(results)));
    /** All photos of the flight, the oldest first, for who leafs through them. */
    this.album = computed(() => this.results.value.filter(({ kind }) => kind === "photo"));
    /** @type {Signal<number | null>} the number of the result that is looked at */
    this.chosen = signal(null);
    /** @type {Signal<number | null>} the number of the photo that is seen large */
    this.opened = signal(null);
    /** @type {Signal<Filters>} */
    this.filters = signal(ALL);
    this.order = signal({ column: /** @type {Column} */ ("time"), down: true });
    this.rows = computed(() => this.results.value.map(rowOf));
    this.listed = computed(() =>
      sorted(filtered(this.rows.value, this.filters.value), this.order.value, language.value));
  }

  /** The results of the layers of a kind that are on, the oldest first. @param {Layer["kind"]} kind */
  of(kind) {
    return this.shown.value.filter((layer) => layer.kind === kind).flatMap(({ results }) => results);
  }

  /** The layers of numbers that are on. */
  numbers() {
    return this.shown.value.filter(({ kind }) => kind === "heat" || kind === "values");
  }

  /** @param {number | null} number @returns {Result | undefined} */
  find(number) {
    return number === null ? undefined : this.results.value.find((one) => one.number === number);
  }

  /** The results under a pointer, the newest first. @param {At} at @param {number} scale */
  under(at, scale) {
    const [pins, values, photos] = [this.pins.peek(), this.values.peek(), this.photos.peek()];
    return hit(at, scale, { pins, values, photos });
  }

  /** @param {string} layer @param {boolean} isOn */
  turn(layer, isOn) {
    prefs.layers.value = { ...prefs.layers.peek(), [layer]: isOn };
  }

  /** @param {Column} column */
  sortBy(column) {
    const { column: now, down } = this.order.peek();
    this.order.value = { column, down: now === column ? !down : false };
  }

  /** @param {Partial<Filters>} some */
  filter(some) {
    this.filters.value = { ...this.filters.peek(), ...some };
  }
}
