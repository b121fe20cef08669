"""Browsers that watch: what they cost their main thread, and how old what they show is.

The age is that of what is on the screen: every 20 ms, now less the moment at which what was painted
last was made. So the time between two updates counts, too.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

from .server import seconds_of

ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

LISTEN = """
(() => {
  const ages = [];
  let painted = 0, updates = 0;
  window.__ages = () => ({ages: ages.splice(0), updates});
  const heard = (event) => {
    const made = /"made_at":\\s*(\\d+)/.exec(event.data);
    if (!made) return;
    updates += 1;
    requestAnimationFrame(() => setTimeout(() => { painted = Number(made[1]); }));
  };
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...given) { super(...given); this.addEventListener("message", heard); }
  };
  setInterval(() => { if (painted) ages.push(Date.now() - painted); }, 20);
})();
"""
"""Put into pages before their own scripts: it hears what they hear, and notes when it was painted."""

PAINTED = """
() => performance.getEntriesByName("first-contentful-paint").map((entry) => entry.startTime)[0]
"""

SIGHT = """
() => {
  performance.clearResourceTimings();
  let seen = 0;
  window.__sight = new Promise((told) => {
    const look = () => {
      const bound = [...document.querySelectorAll(".drone .bound")];
      if (!seen && bound.some((one) => one.checkVisibility())) seen = performance.now();
      const start = performance.getEntriesByType("resource").find(({ name }) => name.endsWith("/api/start"));
      if (seen && start) told(seen - start.startTime);
      else requestAnimationFrame(look);
    };
    look();
  });
}
"""
"""It promises the milliseconds from Start to the first drone on the map that is bound for a target."""


@dataclass(slots=True)
class Tab:
    """A page of the station."""

    page: Page

    def ages(self) -> tuple[list[int], int]:
        """Return the milliseconds of age since this was last asked, and the updates in all."""
        found: dict[str, Any] = self.page.evaluate("() => window.__ages()")
        return found["ages"], found["updates"]


def main_threads(browser: Browser) -> dict[int, float]:
    """Return the seconds of CPU that each page's main thread has used, by its process.

    DevTools would tell of seconds on the clock, which a busy machine makes longer.
    """
    devtools = browser.new_browser_cdp_session()
    processes = devtools.send("SystemInfo.getProcessInfo")["processInfo"]
    devtools.detach()
    return {
        one["id"]: seconds_of(one["id"], one["id"])  # the first thread has the process's number
        for one in processes
        if one["type"] == "renderer"
    }


@contextmanager
def browser() -> Iterator[Browser]:
    """Start a browser that has never been here."""
    # first the one that people have: what it costs them is measured
    names = ("chromium", "chromium-browser", "chromium-headless-shell")
    path = next(filter(None, map(shutil.which, names)), None)
    with sync_playwright() as driver:
        found = driver.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield found
        found.close()


def opened(browser: Browser, url: str, *, listening: bool) -> Tab:
    """Open the Monitor in a window of its own, that is seen."""
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    if listening:
        page.add_init_script(LISTEN)
    page.goto(url)
    page.get_by_role("tab", name="Monitor").or_(page.get_by_role("link", name="Monitor")).click()
    return Tab(page=page)


@dataclass(frozen=True, slots=True)
class FirstVisit:
    """What a browser that has just started gets to see."""

    painted: float
    """Seconds from asking for the page to the first paint."""
    kilobytes: float
    """Of all that came over the line for it, heads included."""
    requests: int


def first_visit(url: str) -> FirstVisit:
    """Open the page in a browser that has never been here, until nothing more is asked for."""
    with browser() as found:
        page = found.new_page()
        devtools = page.context.new_cdp_session(page)
        came: list[float] = []
        devtools.on("Network.loadingFinished", lambda told: came.append(told["encodedDataLength"]))
        devtools.send("Network.enable")
        page.goto(url)
        while page.evaluate(PAINTED) is None:  # the page's rules let nothing within it ask again
            page.wait_for_timeout(20)
        page.get_by_role("button", name="Use the example plan").wait_for()
        page.wait_for_load_state("networkidle")  # the other pages come behind the first one
        milliseconds: float = page.evaluate(PAINTED)
        return FirstVisit(milliseconds / 1000, sum(came) / 1000, len(came))


def first_drone(url: str) -> float:
    """Hold Start on the page, and return the seconds until a drone is seen to set out."""
    with browser() as found:
        page = found.new_page(viewport={"width": 1280, "height": 800})
        page.goto(url)
        page.locator("button.hold:not([aria-disabled])").hover()
        page.evaluate(SIGHT)
        page.mouse.down()
        milliseconds: float = page.evaluate("() => window.__sight")
        return milliseconds / 1000
