// The little of a browser that the pages' model asks for, so that it runs in Node; it speaks English.

/** @type {Map<string, string>} */
const kept = new Map();

Object.assign(globalThis, {
  localStorage: {
    getItem: (/** @type {string} */ name) => kept.get(name) ?? null,
    setItem: (/** @type {string} */ name, /** @type {string} */ text) => kept.set(name, text),
    removeItem: (/** @type {string} */ name) => kept.delete(name),
  },
  window: new EventTarget(),
  document: { documentElement: { lang: "", dataset: {} }, hidden: false },
  location: { hash: "", pathname: "/", origin: "http://localhost" },
});
Object.defineProperty(globalThis, "navigator", { value: { languages: ["en-GB"] }, configurable: true });

const { speak } = await import("../../../../runtime/pluto_fleet/station/pages/core/i18n.js");
await speak("en");
