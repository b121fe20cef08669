"""A browser, the network or the server that dies in mid-flight costs no mission, and does nothing twice."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, Route, WebSocketRoute, expect

from tests.kit.browser import BREAKS, Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, DONE, names, put_in
from tests.library.station.browser.steps import (
    add_mission,
    drag,
    open_page,
    sees_all,
    settled,
    start,
)


class Network:
    """Between a page and its station: it can be cut, and go silent, as where a cable is pulled out."""

    def __init__(self) -> None:
        self._is_cut = self._is_silent = False
        self._lines: list[WebSocketRoute] = []
        self._waiting: list[Route] = []

    def over(self, page: Page) -> None:
        """Lie between a page and all addresses of its station."""
        page.route("**/api/**", self._asked)
        page.route_web_socket("**/api/live", self._opened)

    def cut(self) -> None:
        """Break every connection, and let none through."""
        self._is_cut = True
        for line in self._lines:
            line.close()
        for route in self._waiting:
            route.abort()
        self._lines, self._waiting = [], []

    def hush(self) -> None:
        """Let nothing through, and say nothing."""
        self._is_silent = True

    def mend(self) -> None:
        """Let everything through again; what is old is gone."""
        self.cut()
        self._is_cut = self._is_silent = False

    def _asked(self, route: Route) -> None:
        if self._is_cut:
            route.abort()
        elif self._is_silent:
            self._waiting.append(route)
        else:
            route.fallback()

    def _opened(self, page: WebSocketRoute) -> None:
        if self._is_cut:
            page.close()
            return
        self._lines.append(page)
        station = page.connect_to_server()
        page.on_message(lambda said: None if self._is_silent else station.send(said))
        station.on_message(lambda said: None if self._is_silent else page.send(said))


@pytest.fixture
def station(serve: Serve) -> Station:
    """A station with the exercise's plan."""
    return put_in(serve())


def lost(page: Page) -> Locator:
    """Return what says that the connection is lost."""
    return page.get_by_role("alert").filter(has_text="Connection lost")


def flies_until_the_pills_are_picked(page: Page, station: Station) -> None:
    """Start, and wait until the flight is in its middle."""
    start(page)
    until(lambda: ("pick_item", "Mission 3/1/0") in station.done(), "the pills are picked")


def completes_all_once(page: Page, station: Station) -> None:
    """Watch all missions to their end; nothing was done twice."""
    sees_all(page, "Completed")
    assert station.statuses() == COMPLETED
    assert station.done() == DONE


def test_a_network_that_breaks_and_comes_back_is_said_and_the_page_picks_up_by_itself(
    station: Station, visit: Visit, watch: Watch
) -> None:
    watch.expected += BREAKS
    network = Network()
    page = visit(station, prepare=network.over)
    flies_until_the_pills_are_picked(page, station)
    network.cut()
    expect(lost(page)).to_be_visible()
    network.mend()
    expect(lost(page)).to_have_count(0)
    network.hush()
    expect(lost(page)).to_be_visible()
    network.mend()
    completes_all_once(page, station)


@pytest.mark.long  # a whole flight once more
def test_an_answer_that_is_lost_starts_nothing_twice(
    station: Station, visit: Visit, watch: Watch
) -> None:
    """The page asks again, and names the same command."""
    watch.expected += BREAKS
    page = visit(station)
    asked: list[str] = []
    page.route("**/api/start", lambda route: _lose_first(route, asked))
    start(page)
    open_page(page, "Monitor")
    sees_all(page, "Completed")
    assert len(asked) == 2
    assert asked[0] == asked[1]
    assert len(station.journals()) == 1
    assert station.done() == DONE


def kept(page: Page, station: Station) -> list[str]:
    """Return the missions that the station keeps, once what the page has just asked went on its way."""
    settled(page)
    return names(station)


@pytest.mark.long
def test_what_is_drawn_without_a_network_is_kept_and_saved_when_it_is_back(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    watch.expected += BREAKS
    station = serve("drugs_distribution")
    network = Network()
    page = visit(station, prepare=network.over)
    add_mission(page, "Before")
    until(lambda: kept(page, station) == ["Before"], "it is kept")
    page.locator("html[data-loaded=all]").wait_for()
    network.cut()
    add_mission(page, "Meanwhile")
    drag(page, "measure", (3.0, 5.0))
    expect(page.get_by_text("Not saved yet")).to_be_visible()
    assert names(station) == ["Before"]
    network.mend()
    until(lambda: kept(page, station) == ["Before", "Meanwhile"], "it is saved by itself")
    expect(page.get_by_text("Not saved yet")).to_be_hidden()


def _lose_first(route: Route, asked: list[str]) -> None:
    """Let the station hear it, and the page no answer; the next one goes as it should."""
    asked.append(route.request.post_data or "")
    if len(asked) == 1:
        route.fetch()
        route.abort()
    else:
        route.continue_()


def test_stop_is_heard_though_nothing_is_seen_any_more(
    station: Station, visit: Visit, watch: Watch
) -> None:
    """Neither WebSocket nor polling answers; the button is there, and what it sends arrives."""
    watch.expected += BREAKS
    page = visit(station)
    start(page)
    until(lambda: station.phase == "flying", "it flies")
    page.context.route("**/api/live*", lambda route: route.abort())
    page.route_web_socket("**/api/live", lambda line: line.close())
    page.reload()
    page.get_by_role("button", name="Stop: land now").click()
    until(lambda: station.phase == "stopped", "all have landed")
