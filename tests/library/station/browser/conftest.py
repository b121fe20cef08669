"""Ground stations of examples, and browsers that look at them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page

from tests.kit.browser import LAPTOP, Contexts
from tests.kit.station import Station, Stations
from tests.library.station.browser.exercise import put_in


class Serve:
    """Gives the station of an example; one that is only this test's can be killed."""

    def __init__(self, stations: Stations) -> None:
        self._stations = stations
        self.own_ones: list[Station] = []

    def __call__(
        self, app: str = "drugs_distribution", *options: str, own: bool = False
    ) -> Station:
        if "--speed" not in options:
            options = ("--speed", "20", *options)
        if not own:
            return self._stations.shared(app, *options)
        station = self._stations.fresh(app, *options)
        self.own_ones.append(station)
        station.start()
        return station


@pytest.fixture
def serve(stations: Stations) -> Iterator[Serve]:
    """Serve examples; of those that are a test's own no process is left behind."""
    serve = Serve(stations)
    yield serve
    for station in serve.own_ones:
        station.end()


@pytest.fixture
def ward(serve: Serve) -> Station:
    """A station where nothing flies."""
    return serve()


@pytest.fixture
def planned(ward: Station) -> Station:
    """A station with the exercise's plan, in which nothing is wrong."""
    return put_in(ward)


class Visit:
    """Opens a station in a browser of its own, that shares nothing with the other ones."""

    def __init__(self, contexts: Contexts) -> None:
        self._contexts = contexts

    def __call__(
        self,
        station: Station,
        *,
        size: tuple[int, int] = LAPTOP,
        touch: bool = False,
        path: str = "",
        prepare: Callable[[Page], object] = lambda _: None,
    ) -> Page:
        page = self._contexts.page(size=size, has_touch=touch)
        prepare(page)
        page.goto(f"http://127.0.0.1:{station.port}{path}" if path else station.url)
        return page


@pytest.fixture
def visit(contexts: Contexts) -> Visit:
    """Open stations in browsers."""
    return Visit(contexts)
