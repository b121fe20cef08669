"""What moves and what happens, on the Monitor: one sees who follows what, and raises events oneself."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.browser import Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.steps import A_FLIGHT, open_page, row_of, start
from tests.pages.scenes import lists
from tests.paths import EXAMPLES

MISSIONS = ("--missions", str(EXAMPLES / "pursue" / "missions.toml"))
MIDDLE = {"x": 300, "y": 250}
"""Pixels of the map where nothing stands but the ground."""


def raised(page: Page) -> None:
    """Press the button."""
    page.get_by_role("button", name="Raise", exact=True).click()


def field(page: Page, name: str) -> Locator:
    """Return a field of what is raised, with what is said of it."""
    return page.locator(f"details.join [data-field={name}]")


def patrols(serve: Serve, visit: Visit) -> tuple[Station, Page]:
    """Start the patrols, and look at what happens."""
    station = serve("pursue", *MISSIONS, "--speed", "5")
    page = visit(station)
    start(page)
    open_page(page, "Monitor")
    lists(page, "Events")
    return station, page


def test_a_person_raises_an_event_which_makes_a_mission_and_all_of_it_is_seen(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    watch.expected += ["409"]
    station, page = patrols(serve, visit)
    until(lambda: bool(station.in_the_air()), "something flies")
    page.get_by_text("Raise an event…").click()
    field(page, "x").locator("input").fill("far")
    raised(page)
    expect(field(page, "x")).to_contain_text("metres")
    field(page, "x").locator("input").fill("99")
    field(page, "y").locator("input").fill("1")
    raised(page)
    expect(field(page, "x")).to_contain_text("outside the map")
    page.get_by_role("button", name="Pick on the map").click()
    page.locator("svg.floor-picture").click(position=MIDDLE)  # type: ignore[arg-type]
    expect(field(page, "x").locator("input")).not_to_have_value("99")
    field(page, "kind").locator("input").fill("dog")
    raised(page)
    happened = page.locator(".event-entry")
    expect(happened.filter(has_text="kind: dog")).to_contain_text("pursue made no mission of it")

    until(lambda: any(one["id"] == "t1" for one in tracked(station)), "t1 is seen")
    page.get_by_label("About").select_option("t1")
    raised(page)
    mine = happened.filter(has_text="chase t1")
    expect(mine.first).to_be_visible()
    expect(page.locator(".pursuit")).not_to_have_count(0, timeout=A_FLIGHT)
    mine.first.get_by_role("button", name=re.compile("^chase t1")).click()
    expect(row_of(page, "chase t1").locator(".trip-lines")).to_contain_text("track t1")
    page.get_by_role("button", name="Stop: land now").click()
    until(lambda: station.phase == "stopped", "all have landed")


def tracked(station: Station) -> list[dict[str, str]]:
    """Return what is tracked now."""
    tracks: list[dict[str, str]] = station.now().get("tracks", [])
    return tracks


@pytest.mark.long
def test_who_watches_sees_what_happens_and_is_offered_no_event(serve: Serve, visit: Visit) -> None:
    station = serve("pursue", *MISSIONS, "--speed", "5", "--name", "ward.example")
    watcher = visit(station, path=station.url_to_watch.partition(str(station.port))[2])
    station.tell("start")
    open_page(watcher, "Monitor")
    lists(watcher, "Events")
    expect(watcher.locator(".event-entry").first).to_be_visible(timeout=A_FLIGHT)
    expect(watcher.get_by_text("Raise an event…")).to_have_count(0)


def test_an_app_without_events_shows_none(ward: Station, visit: Visit) -> None:
    page = visit(ward)
    open_page(page, "Monitor")
    tabs = page.get_by_role("tablist", name="Lists beside the map").get_by_role("tab")
    expect(tabs.first).to_be_visible()
    assert "Events" not in tabs.all_inner_texts()
