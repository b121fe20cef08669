// The little of a browser that the pages' model asks for, so that it runs in Node.

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

