// The texts in all languages, and what the station says by keys.

import "./browser.js";
import assert from "node:assert/strict";
import { after, test } from "node:test";

const PAGES = "../../../../runtime/pluto_fleet/station/pages";
const { bestLanguage, has, isTranslated, language, LANGUAGES, say, speak, t } = await import(`${PAGES}/core/i18n.js`);
const names = Object.keys(LANGUAGES);
/** @type {Record<string, Record<string, string | { one: string, other: string }>>} */
const catalogues = Object.fromEntries(await Promise.all(names.map(async (name) =>
  [name, (await import(`${PAGES}/texts/${name}.js`)).default])));

/** @param {string | { one: string, other: string }} text */
const forms = (text) => (typeof text === "string" ? [text] : [text.one, text.other]);
/** The facts of a text in all its forms; n may be left to a form. @param {string | { one: string, other: string }} text */
const facts = (text) => [...new Set(forms(text).flatMap((form) => form.match(/\{\w+\}/g) ?? []))].filter((fact) => fact !== "{n}").sort();

/** Whether the fact n is given. @param {string} key @param {string | { one: string, other: string }} text */
const isCounted = (key, text) => typeof text !== "string" || text.includes("{n}") || key.startsWith("said.");

after(() => speak("en"));

for (const name of names) {
  test(`${name} has every text, none empty, with the same facts as the others`, () => {
    const all = { ...catalogues.it, ...catalogues.en }; // what the station says has no English here
    const own = Object.keys(all).filter((key) => name !== "en" || !key.startsWith("said."));
    assert.deepEqual(Object.keys(catalogues[name]), own.sort()); // in order, so that two new ones seldom meet in a merge
    for (const [key, text] of Object.entries(catalogues[name])) {
      assert.ok(forms(text).every((form) => form.trim()), key);
      assert.deepEqual(facts(text), facts(all[key]), key);
      assert.ok(isCounted(key, all[key]) || !isCounted("", text), `${key} has no n`);
    }
  });
}

test("the best language is the first of those wanted that there is, else English", () => {
  assert.equal(bestLanguage(["", "fr-CA", "de-AT", "it"]), "de");
  assert.equal(bestLanguage(["IT"]), "it");
  assert.equal(bestLanguage(["den", "constructor", "fr"]), "en");
});

test("once a language is spoken, its texts, numbers and lists are", async () => {
  await speak("de");
  assert.equal(language.value, "de");
  assert.equal(document.documentElement.lang, "de");
  assert.equal(t("many.missions", { n: 1 }), "1 Mission");
  assert.equal(t("map.at", { x: 1.5, y: 2 }), "bei 1,5; 2");
  assert.ok(has("close") && !has("constructor"));
});

test("of two languages that are chosen at once the last is spoken", async () => {
  await Promise.all([speak("de"), speak("it")]);
  assert.equal(t("close"), "Chiudi");
});

test("that a drone has broken its reserve is said in every language", async () => {
  const drained = { key: "alert.drained", facts: { drone: "cf1", level: 0.071 }, text: "cf1 came home with 7 %" };
  const said = { en: "cf1 came home with 7 %", it: "cf1 è rientrato con 7% di batteria, meno della sua riserva" };
  for (const [name, words] of Object.entries({ ...said, de: "cf1 kam mit 7\u00a0% im Akku heim, weniger als ihre Reserve" })) {
    await speak(name);
    assert.equal(say(drained), words);
  }
});

test("what the station says is said with its facts, and without what it does not know", async () => {
  await speak("it");
  const lost = { key: "alert.lost", facts: { drone: "cf1", why: "" }, text: "cf1 is lost" };
  assert.equal(say(lost), "cf1 è perso");
  assert.equal(say({ ...lost, facts: { drone: "cf1", why: "radio" } }), "cf1 è perso: radio");
  const waiting = { missions: 9, low: 2, takes: 0.5, ready_in: 240, flying: 1, charging: 0, lost: 1 };
  assert.equal(say({ key: "alert.waiting", facts: waiting, text: "" }),
    "9 missioni aspettano un drone. Droni: 1 in volo; 2 con batteria bassa, serve 50%, il primo pronto fra circa 4 min; 1 persi");
  const drones = ["cf1", "cf2", "cf3", "cf4", "cf5"];
  assert.match(say({ key: "alert.battery", facts: { drones, ready_in: 30 }, text: "" }), /^cf1, cf2, cf3 e 2 altri: .* 30 s$/);
  const few = { missions: 2, of: 5, drones: ["cf1"], action: "pick", mass: 0.04 };
  assert.match(say({ key: "preflight.few-lift", facts: few, text: "" }), /cf1.* 40 g$/);
});

test("what has no translation is the station's own English, and known as that", async () => {
  await speak("it");
  const own = { key: "preflight.refused", facts: { why: "no mission" }, text: "no mission" };
  assert.equal(say(own), "no mission");
  assert.equal(isTranslated(own), false);
  assert.equal(say({ key: "alert.of-another-version", facts: {}, text: "What?" }), "What?");
});
