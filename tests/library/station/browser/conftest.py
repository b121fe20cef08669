"""Ground stations of examples, and browsers that look at them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Protocol

import pytest
from playwright.sync_api import Page

from tests.kit.browser import LAPTOP, Contexts, Scheme
from tests.kit.station import Station, Stations
from tests.library.station.browser.exercise import put_in

APP = "drugs_distribution"


class Serve(Protocol):
    """Gives the station of an example; one that is only this test's can be killed."""

    def __call__(self, app: str = APP, *options: str, own: bool = False) -> Station: ...


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


@pytest.fixture
def serve(stations: Stations) -> Iterator[Serve]:
    """Serve examples; of those that are a test's own no process is left behind."""
    own_ones: list[Station] = []

    def serve(app: str = APP, *options: str, own: bool = False) -> Station:
        if "--speed" not in options:
            options = ("--speed", "20", *options)
        if not own:
            return stations.shared(app, *options)
        station = stations.fresh(app, *options)
        own_ones.append(station)
        station.start()
        return station

    yield serve
    for station in own_ones:
        station.end()


@pytest.fixture
def visit(contexts: Contexts) -> Visit:
    """Open stations in browsers of their own, that are watched."""

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
        page = contexts.page(size=size, scheme=scheme, has_touch=touch)
        if prepare is not None:
            prepare(page)
        address = f"http://127.0.0.1:{station.port}{path}" if path else station.url
        page.goto(address.replace(str(station.port), str(port or station.port)))
        return page

    return visit


@pytest.fixture
def planned(ward: Station) -> Station:
    """A station with the exercise's plan, in which nothing is wrong."""
    return put_in(ward)


@pytest.fixture
def ward(serve: Serve) -> Station:
    """A station where nothing flies."""
    return serve()
