// Walking through a list of buttons with the arrow keys.

/** Move the focus to the button before or after. @param {string} of a selector of the buttons @returns {(event: KeyboardEvent) => void} */
export const walking = (of) => (event) => {
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  const here = /** @type {Element} */ (event.target).closest(of);
  if (!step || !here) return;
  event.preventDefault();
  const all = [.../** @type {Element} */ (event.currentTarget).querySelectorAll(of)];
  const next = all[all.indexOf(here) + step];
  if (next instanceof HTMLElement) next.focus();
};
