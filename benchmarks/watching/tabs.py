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

from playwright.sync_api import Browser, CDPSession, Page, sync_playwright

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
    const made = /"made":\\s*(\\d+)/.exec(event.data);
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


@dataclass(slots=True)
class Tab:
    """A page of the station."""

    page: Page
    devtools: CDPSession

    @property
    def busy(self) -> float:
        """Seconds of CPU that its main thread has used."""
        metrics = self.devtools.send("Performance.getMetrics")["metrics"]
        found: dict[str, float] = {one["name"]: one["value"] for one in metrics}
        return found["TaskDuration"]

    def ages(self) -> tuple[list[int], int]:
        """Return the milliseconds of age since this was last asked, and the updates in all."""
        found: dict[str, Any] = self.page.evaluate("() => window.__ages()")
        return found["ages"], found["updates"]


@contextmanager
def browser() -> Iterator[Browser]:
    """Start a browser that has never been here."""
    path = shutil.which("chromium") or shutil.which("chromium-browser")
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
    devtools = context.new_cdp_session(page)
    # Of CPU, not of the clock: a busy machine makes nobody's main thread busier.
    devtools.send("Performance.setTimeDomain", {"timeDomain": "threadTicks"})
    devtools.send("Performance.enable")
    page.goto(url)
    page.get_by_role("tab", name="Monitor").or_(page.get_by_role("link", name="Monitor")).click()
    return Tab(page=page, devtools=devtools)


def first_paint(url: str) -> float:
    """Return the seconds until a browser that has just started shows something."""
    with browser() as found:
        page = found.new_page()
        page.goto(url)
        page.wait_for_function(f"({PAINTED})() !== undefined")
        milliseconds: float = page.evaluate(PAINTED)
        return milliseconds / 1000
