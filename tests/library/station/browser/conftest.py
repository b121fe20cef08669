"""A browser, and ground stations of installed examples for it to look at."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Literal, Protocol

import pytest
from playwright.sync_api import (
    Browser,
    BrowserContext,
    BrowserType,
    Page,
    Playwright,
    expect,
    sync_playwright,
)

from tests.library.station.browser.chrome import ARGUMENTS, chromium
from tests.library.station.browser.installed import App, installed
from tests.library.station.browser.serving import Station
from tests.library.station.browser.watched import Watch

LAPTOP = (1280, 800)
TABLET = (820, 1180)

Scheme = Literal["light", "dark"]

A_STEP = 30_000
"""Milliseconds until what a page does not do is called a failure: machines may be busy."""

expect.set_options(timeout=A_STEP)

APPS = (
    *("drugs_distribution", "alfalfa", "drugs_distribution_retry", "night_ward"),
    *("aerial_mapping", "pm10"),
)


class Serve(Protocol):
    """Starts the station of an example."""

    def __call__(self, app: str = "drugs_distribution", *options: str) -> Station: ...


class Visit(Protocol):
    """Opens a station in a browser of its own, that shares nothing with the other ones."""

    def __call__(
        self,
        station: Station,
        *,
        size: tuple[int, int] = LAPTOP,
        scheme: Scheme = "light",
        touch: bool = False,
        port: int = 0,
        path: str = "",
        prepare: Callable[[Page], object] | None = None,
    ) -> Page: ...


# The plugin's own are there until the session ends, and with them an event loop that runs: then no
# other test of the same worker could have one. These go with their module.


@pytest.fixture(scope="module")
def playwright() -> Iterator[Playwright]:
    """Drive browsers."""
    with sync_playwright() as driver:
        yield driver


@pytest.fixture(scope="module")
def browser_type(playwright: Playwright) -> BrowserType:
    """Drive Chromium."""
    return playwright.chromium


@pytest.fixture(scope="module")
def browser(browser_type: BrowserType) -> Iterator[Browser]:
    """Debian's Chromium."""
    browser = browser_type.launch(executable_path=chromium(), args=ARGUMENTS)
    yield browser
    browser.close()


@pytest.fixture(scope="session")
def apps(tmp_path_factory: pytest.TempPathFactory) -> dict[str, App]:
    """Install the examples, once for all workers."""
    chromium()  # before anything is made for it
    base = tmp_path_factory.getbasetemp()
    shared = base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base
    return installed(APPS, shared / "stations")


@pytest.fixture
def serve(apps: dict[str, App], tmp_path: Path) -> Iterator[Serve]:
    """Start stations; none of their processes is left behind."""
    stations: list[Station] = []

    def serve(app: str = "drugs_distribution", *options: str) -> Station:
        folder = tmp_path / f"station{len(stations)}"
        folder.mkdir()
        speed = () if "--speed" in options else ("--speed", "20")
        station = Station(app=apps[app], folder=folder, options=(*speed, *options))
        stations.append(station)
        station.start()
        return station

    yield serve
    for station in stations:
        station.end()


@pytest.fixture(scope="module")
def ward(apps: dict[str, App], tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """Serve a station for all that only draw."""
    folder = tmp_path_factory.mktemp("ward")
    station = Station(
        app=apps["drugs_distribution"], folder=folder / "0", options=("--speed", "20")
    )
    station.folder.mkdir()
    station.start()
    yield station
    station.end()


@pytest.fixture
def watch() -> Iterator[Watch]:
    """Fail the test for what any of its pages complains of, or asks of another server."""
    watch = Watch()
    yield watch
    assert watch.unexpected() == []
    assert watch.abroad() == []


@pytest.fixture
def visit(browser: Browser, watch: Watch) -> Iterator[Visit]:
    """Open stations in browsers of their own, that are watched."""
    contexts: list[BrowserContext] = []

    def visit(
        station: Station,
        *,
        size: tuple[int, int] = LAPTOP,
        scheme: Scheme = "light",
        touch: bool = False,
        port: int = 0,
        path: str = "",
        prepare: Callable[[Page], object] | None = None,
    ) -> Page:
        context = browser.new_context(
            viewport={"width": size[0], "height": size[1]},
            color_scheme=scheme,
            has_touch=touch,
            reduced_motion="no-preference",
        )
        context.set_default_timeout(A_STEP)
        watch.over(context)
        contexts.append(context)
        page = context.new_page()
        if prepare is not None:
            prepare(page)
        address = f"http://127.0.0.1:{station.port}{path}" if path else station.url
        page.goto(address.replace(str(station.port), str(port or station.port)))
        return page

    yield visit
    for context in contexts:
        context.close()
