"""One Chromium a worker, started for the first test that wants one; each test has contexts of its own in it.

What goes wrong in a page, or leaves the machine, is a test's failure.
"""

from __future__ import annotations

import asyncio
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal
from urllib.parse import urlsplit

import pytest

if TYPE_CHECKING:  # only who drives a browser has to load it
    from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page

LAPTOP = (1366, 768)
DESKTOP = (1920, 1080)
TABLET = (820, 1180)
PHONE = (390, 844)

Scheme = Literal["light", "dark"]
SCHEMES: tuple[Scheme, ...] = ("light", "dark")

A_STEP = 30_000
"""Milliseconds until what a page does not do is called a failure: machines may be busy."""

NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
"""The first one draws the same for a third less of the CPU: it has no windows."""

ARGUMENTS = [
    "--no-sandbox",  # tests may run as root
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def chromium() -> str:
    """Return the browser's path; without one the test is skipped, and in CI it fails."""
    for name in NAMES:
        path = shutil.which(name)
        if path is not None:
            return path
    why = f"none of {', '.join(NAMES)} is on the path: apt install chromium"
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)


@pytest.hookimpl(tryfirst=True)  # before those are left out that have a mark
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark all that drive a browser."""
    for item in items:
        if "chrome" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.browser)


@dataclass(frozen=True, slots=True)
class Chromium:
    """A browser, and the event loop that drives it: while that runs, no test can have another one."""

    browser: Browser
    loop: asyncio.AbstractEventLoop


@pytest.fixture(scope="session")
def chrome_of_this_worker() -> Iterator[Chromium]:
    """Debian's Chromium, without a page."""
    path = chromium()
    from playwright.sync_api import expect, sync_playwright

    expect.set_options(timeout=A_STEP)
    driver = sync_playwright().start()
    loop = asyncio.get_running_loop()
    browser = driver.chromium.launch(executable_path=path, args=ARGUMENTS)
    asyncio._set_running_loop(None)
    yield Chromium(browser, loop)
    asyncio._set_running_loop(loop)
    browser.close()
    driver.stop()


@pytest.fixture
def chrome(chrome_of_this_worker: Chromium) -> Iterator[Browser]:
    """The worker's Chromium, for as long as one test lasts; the other tests have their own loops."""
    asyncio._set_running_loop(chrome_of_this_worker.loop)
    yield chrome_of_this_worker.browser
    asyncio._set_running_loop(None)


@pytest.fixture
def watch() -> Iterator[Watch]:
    """Fail the test for what any of its pages complains of, or asks of another machine."""
    watch = Watch()
    yield watch
    assert watch.unexpected() == []
    assert watch.abroad() == []


class Contexts:
    """Opens pages in contexts that share nothing, and are watched."""

    def __init__(self, browser: Browser, watch: Watch) -> None:
        self._browser, self._watch = browser, watch
        self._open: list[BrowserContext] = []

    def page(self, *, size: tuple[int, int] = LAPTOP, **options: Any) -> Page:
        """Open an empty page of this size."""
        context = self._browser.new_context(
            viewport={"width": size[0], "height": size[1]},
            color_scheme="light",
            reduced_motion="no-preference",
            **options,
        )
        self._open.append(context)
        context.set_default_timeout(A_STEP)
        self._watch.over(context)
        return context.new_page()

    def close(self) -> None:
        """Close all of them."""
        for context in self._open:
            context.close()


@pytest.fixture
def contexts(chrome: Browser, watch: Watch) -> Iterator[Contexts]:
    """Contexts of one test."""
    contexts = Contexts(chrome, watch)
    yield contexts
    contexts.close()


HERE = ("127.0.0.1", "localhost")
NO_NETWORK = ("data", "blob", "about", "chrome-error")

BREAKS = ("WebSocket", "ERR_", "Failed to load resource")
"""What a page complains of while its server is away."""


@dataclass  # without slots: playwright keeps something in its listeners
class Watch:
    """What pages have complained of, and whom they have asked."""

    complaints: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    expected: list[str] = field(default_factory=list)
    """Parts of complaints that a test brings about: a server that it has killed."""

    def over(self, context: BrowserContext) -> None:
        """Watch all pages of a context."""
        context.on("page", self._page)
        context.on("request", lambda request: self.asked.append(request.url))

    def _page(self, page: Page) -> None:
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.complaints.append(f"uncaught: {error}"))

    def _console(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            where = message.location
            self.complaints.append(f"{message.type}: {message.text} ({where.get('url', '')})")

    def abroad(self) -> list[str]:
        """Return the addresses that are not on this machine."""
        return [url for url in self.asked if not _is_here(url)]

    def unexpected(self) -> list[str]:
        """Return the complaints that the test has not brought about itself."""
        return [one for one in self.complaints if not any(part in one for part in self.expected)]


def _is_here(url: str) -> bool:
    parts = urlsplit(url)
    return parts.scheme in NO_NETWORK or parts.hostname in HERE
