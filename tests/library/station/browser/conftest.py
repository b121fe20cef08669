"""Ground stations of examples, and browsers that look at them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page

from tests.kit.browser import LAPTOP, Contexts
from tests.kit.station import Station, Stations
from tests.library.station.browser.exercise import put_in

Serve = Callable[..., Station]


@pytest.fixture
def serve(stations: Stations) -> Iterator[Serve]:
    """Serve examples; one that is only this test's can be killed, and no process of it is left behind."""
    own_ones: list[Station] = []

    def serve(app: str = "drugs_distribution", *options: str, own: bool = False) -> Station:
        if "--speed" not in options:
            options = ("--speed", "20", *options)
        if not own:
            return stations.shared(app, *options)
        own_ones.append(stations.fresh(app, *options))
        own_ones[-1].start()
        return own_ones[-1]

    yield serve
    for station in own_ones:
        station.end()


@pytest.fixture
def ward(serve: Serve) -> Station:
    """A station where nothing flies."""
    return serve()


@pytest.fixture
def planned(ward: Station) -> Station:
    """A station with the exercise's plan, in which nothing is wrong."""
    return put_in(ward)


Visit = Callable[..., Page]


@pytest.fixture
def visit(contexts: Contexts) -> Visit:
    """Open stations in browsers of their own, which share nothing with each other."""

    def visit(
        station: Station,
        *,
        size: tuple[int, int] = LAPTOP,
        touch: bool = False,
        path: str = "",
        prepare: Callable[[Page], object] = lambda _: None,
    ) -> Page:
        page = contexts.page(size=size, has_touch=touch)
        prepare(page)
        page.goto(f"http://127.0.0.1:{station.port}{path}" if path else station.url)
        return page

    return visit
