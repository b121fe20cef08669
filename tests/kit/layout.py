"""What a person sees at a glance, and a program can say: nothing lies over anything, all can be hit."""

from __future__ import annotations

from playwright.sync_api import Page

SEEN = """
const seen = (one) => one.checkVisibility({ opacityProperty: true, visibilityProperty: true });
const said = (one) => one.outerHTML.slice(0, 160);
const scrolls = (one) => getComputedStyle(one).overflow !== "visible";
const onTop = ".dialog, .drone-card, .result-card, .questions, .notices"; // is meant to lie over a page
const over = (one) => ({ dialog: ".dialog, .notices", notices: ".notices" })[one.classList[0]] ?? onTop; // what it may not cover
"""


def script(begin: str, body: str) -> str:
    """Return a function of a page that knows what is seen."""
    return f"{begin}\n{SEEN}{body}"


COVERED = script(
    "() => {",
    """
  const found = [];
  const all = "button, [role=button], a[href], input, select, summary, [role=tab], [role=option]";
  for (const one of document.querySelectorAll(all)) {
    if (!seen(one) || one.closest("svg.floor-picture")) continue; // what flies may fly over what is there
    const box = one.getBoundingClientRect();
    if (!box.width || !box.height) continue;
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    if (x < 0 || y < 0 || x > innerWidth - 1 || y > innerHeight - 1) continue; // no element is found at the very edge
    let clipped = false; // by a list that scrolls
    for (let up = one.parentElement; up; up = up.parentElement) {
      const edge = up.getBoundingClientRect();
      if (scrolls(up) && (x < edge.left || x > edge.right || y < edge.top || y > edge.bottom)) clipped = true;
    }
    if (clipped) continue;
    const top = document.elementFromPoint(x, y);
    const lies = top?.closest(onTop); // it may cover the page, and a dialog what lies on it; nothing covers a Stop
    if (lies && !one.closest(".fly") && !one.closest(over(lies))) continue;
    let stays = false; // what is scrolled goes under a head that stays
    for (let up = top; up; up = up.parentElement) stays ||= getComputedStyle(up).position === "sticky";
    if (stays) continue;
    const same = one.contains(top) || top?.contains(one) || top?.closest("label")?.control === one;
    if (!same) found.push(`${said(one)} lies under ${top && said(top)}`);
  }
  return found;
}
""",
)

SMALL_TARGETS = script(
    "([least, thumb]) => {",
    """
  const atThumb = ".fly .button, .head .tab, .dialog-foot .button, .transport .button, .opener, .questions .button";
  return [...document.querySelectorAll("button, [role=button], [role=tab], select, input, summary")]
    .filter((one) => seen(one) && !one.closest("svg"))
    .filter((one) => getComputedStyle(one).display !== "inline" && !one.matches(".mark-button")) // two buttons lead to the marks
    .map((one) => [one, (one.closest("label") ?? one).getBoundingClientRect(), one.matches(atThumb) ? thumb : least])
    .filter(([, box]) => box.width && box.height)
    .filter(([, box, enough]) => box.width < enough || box.height < enough)
    .map(([one, box]) => `${Math.round(box.width)} x ${Math.round(box.height)}: ${said(one)}`);
}
""",
)

CUT_OFF = script(
    "() => {",
    """
  const words = "button, [role=tab], h1, h2, h3, th, label, .chip, .why > *, .title, .standing-word, dd, dt, .empty, .hint";
  return [...document.querySelectorAll(words)].filter((one) => seen(one) && one.clientWidth && scrolls(one)
    && !one.closest(".cell, .thumb-button, .link") // shortened on purpose: all of it is said where it leads to
    && (one.scrollWidth > one.clientWidth + 1 || one.scrollHeight > one.clientHeight + 3)).map(said);
}
""",
)

STICKS_OUT = script(
    "() => {",
    """
  const found = [];
  for (const one of document.querySelectorAll(".station *")) {
    if (one.closest("svg, .unseen") || !seen(one)) continue;
    const box = one.getBoundingClientRect();
    const within = box.left > -1 && box.top > -1 && box.right < innerWidth + 1 && box.bottom < innerHeight + 1;
    if (within || !box.width || !box.height) continue;
    let up = one.parentElement; // what a list scrolls is not out
    while (up && !scrolls(up) && !up.matches(".unseen")) up = up.parentElement;
    if (!up || up === document.documentElement) found.push(`sticks out: ${said(one)}`);
  }
  const parts = [...document.querySelectorAll(".head > *, .lost-line, main")].filter((one) => seen(one))
    .map((one) => [one, one.getBoundingClientRect()]).filter(([, box]) => box.width > 1 && box.height > 1);
  for (const [one, a] of parts) {
    for (const [other, b] of parts) {
      const apart = a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 1 || b.bottom <= a.top + 1;
      if (one !== other && !apart) found.push(`${said(one)} overlaps ${said(other)}`);
    }
  }
  return found;
}
""",
)

SIDEWAYS = script(
    "() => {",
    """
  return [...document.querySelectorAll(".station *")]
    .filter((one) => seen(one) && ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
    .filter((one) => one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 0 && !one.matches(".report-table"))
    .map((one) => `${one.scrollWidth} in ${one.clientWidth}: ${said(one)}`);
}
""",
)

NAMES = """
() => {
  const stage = document.querySelector(".page:not([hidden]) .floor");
  if (!stage) return [];
  const found = [];
  const names = [...stage.querySelectorAll(".names .name")].map((one) => [one, one.getBoundingClientRect()]);
  names.forEach(([one, a], at) => names.slice(at + 1).forEach(([other, b]) => {
    const apart = a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 1 || b.bottom <= a.top + 1;
    if (!apart) found.push(`the name ${one.textContent} lies over ${other.textContent}`);
  }));
  const named = new Set(names.map(([one]) => one.textContent.split(" ")[0]));
  for (const { dataset: { drone, status } } of stage.querySelectorAll(".drone")) {
    if (status === "LOST" && !named.has(drone)) found.push(`${drone} is lost and has no name`);
  }
  return found;
}
"""

MAP_SHARE = """
() => {
  const box = document.querySelector(".monitor-page:not([hidden]) .floor")?.getBoundingClientRect();
  return box ? (box.width * box.height) / (innerWidth * innerHeight) : 1;
}
"""

LEAST_MAP = 0.45
"""Of the screen, on the Monitor, where the screen is as wide as a laptop's."""
WIDE, NARROW = 1366, 760


def wider_than_the_screen(page: Page) -> int:
    """Return by how many pixels one must scroll to the side."""
    wider: int = page.evaluate("() => document.documentElement.scrollWidth - innerWidth")
    return max(0, wider)


def covered(page: Page) -> list[str]:
    """Return what could be pressed, and has something else above its middle."""
    found: list[str] = page.evaluate(COVERED)
    return found


def too_small(page: Page, least: float, thumb: float = 0) -> list[str]:
    """Return what a finger would miss; where a thumb acts, it may ask for more."""
    found: list[str] = page.evaluate(SMALL_TARGETS, [least, max(least, thumb)])
    return found


def cut_off(page: Page) -> list[str]:
    """Return the words that do not fit where they stand."""
    found: list[str] = page.evaluate(CUT_OFF)
    return found


def sideways(page: Page) -> list[str]:
    """Return the lists that scroll to the side."""
    found: list[str] = page.evaluate(SIDEWAYS)
    return found


def laid_out_badly(page: Page) -> list[str]:
    """Return all that a person would stumble over; fingers need more room than a mouse."""
    found = [*covered(page), *cut_off(page), *sideways(page)]
    found += page.evaluate(STICKS_OUT) + page.evaluate(NAMES)
    if wide := wider_than_the_screen(page):
        found.append(f"{wide} pixels wider than the screen")
    width = page.viewport_size["width"] if page.viewport_size else 0
    if width <= NARROW:
        found += too_small(page, 24, 38)
    share: float = page.evaluate(MAP_SHARE)
    if width >= WIDE and share < LEAST_MAP:
        found.append(f"the map takes {share:.0%} of the Monitor")
    return found
