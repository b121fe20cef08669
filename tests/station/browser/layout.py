"""What a person sees at a glance, and a program can say: nothing lies over anything, all can be hit."""

from __future__ import annotations

from playwright.sync_api import Page

HIDDEN_BUTTONS = """
() => {
  const said = [];
  const all = "button, [role=button], a[href], input, select, [role=tab], [role=option]";
  for (const one of document.querySelectorAll(all)) {
    if (!one.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    const box = one.getBoundingClientRect();
    if (!box.width || !box.height) continue;
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    if (x < 0 || y < 0 || x > innerWidth - 1 || y > innerHeight - 1) continue; // no element is found at the very edge
    let clipped = false; // by a list that scrolls
    for (let up = one.parentElement; up; up = up.parentElement) {
      const edge = up.getBoundingClientRect();
      const scrolls = getComputedStyle(up).overflow !== "visible";
      if (scrolls && (x < edge.left || x > edge.right || y < edge.top || y > edge.bottom)) clipped = true;
    }
    if (clipped) continue;
    if (document.elementFromPoint(x, y)?.closest("[role=status], [role=alert]")) continue; // it goes
    const top = document.elementFromPoint(x, y);
    let stays = false; // what is scrolled goes under a head that stays
    for (let up = top; up; up = up.parentElement) stays ||= getComputedStyle(up).position === "sticky";
    if (stays) continue;
    const same = one.contains(top) || top?.contains(one) || top?.closest("label")?.control === one;
    if (!same) said.push(`${one.outerHTML.slice(0, 120)} lies under ${top?.outerHTML.slice(0, 120)}`);
  }
  return said;
}
"""

SMALL_TARGETS = """
(least) => [...document.querySelectorAll("button, [role=button], [role=tab], select, input")]
  .filter((one) => getComputedStyle(one).display !== "inline") // a word of a sentence
  .filter((one) => one.checkVisibility({ opacityProperty: true, visibilityProperty: true }))
  .map((one) => [one, (one.closest("label") ?? one).getBoundingClientRect()])
  .filter(([, box]) => box.width && box.height)
  .filter(([one, box]) => !one.closest("svg") && (box.width < least || box.height < least))
  .map(([one, box]) =>
    `${Math.round(box.width)} x ${Math.round(box.height)}: ${one.outerHTML.slice(0, 120)}`)
"""

CUT_OFF = """
() => [...document.querySelectorAll("button, [role=tab], h1, h2, h3, th, label, .chip")]
  .filter((one) => one.checkVisibility({ opacityProperty: true, visibilityProperty: true }))
  .filter((one) => one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0
    && getComputedStyle(one).overflow !== "visible")
  .map((one) => one.outerHTML.slice(0, 160))
"""


def wider_than_the_screen(page: Page) -> int:
    """Return by how many pixels one must scroll to the side."""
    wider: int = page.evaluate("() => document.documentElement.scrollWidth - innerWidth")
    return max(0, wider)


def covered(page: Page) -> list[str]:
    """Return what could be pressed, and has something else above its middle."""
    found: list[str] = page.evaluate(HIDDEN_BUTTONS)
    return found


def too_small(page: Page, least: float) -> list[str]:
    """Return what a finger would miss."""
    found: list[str] = page.evaluate(SMALL_TARGETS, least)
    return found


def cut_off(page: Page) -> list[str]:
    """Return the words of buttons and headings that do not fit."""
    found: list[str] = page.evaluate(CUT_OFF)
    return found
