"""The station at work, as pictures and people find it: each page, in each phase."""

from __future__ import annotations

from collections.abc import Iterator

from playwright.sync_api import Page, expect

from tests.station.browser.exercise import put_in
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import (
    A_FLIGHT,
    missions_listed,
    open_page,
    pin_of,
    row_of,
    select_mission,
    start,
)

PAGES = ("Missions", "Trips", "Monitor", "Help")


def scenes(page: Page, station: Station) -> Iterator[str]:
    """Lead a page through everything there is to see; yields the name of what is on the screen."""
    expect(page.get_by_role("button", name="Add the first mission")).to_be_visible()
    yield "empty-missions"
    open_page(page, "Trips")
    yield "empty-trips"
    open_page(page, "Monitor")
    yield "empty-monitor"
    open_page(page, "Help")
    yield "help"
    put_in(station)
    open_page(page, "Missions")
    expect(missions_listed(page)).to_have_count(3)
    select_mission(page, "Mission 3")
    yield "missions"
    open_page(page, "Trips")
    pin_of(page, 1).click()  # opens its card
    yield "trips"
    start(page)
    expect(page.get_by_role("tab", name="Monitor")).to_have_attribute("aria-selected", "true")
    row_of(page, "Mission 3").get_by_role("button", name="Mission 3").click()
    until(lambda: ("pick_item", "Mission 3/1/0") in station.done(), "the pills are picked")
    expect(page.get_by_text("3 missions started")).to_have_count(0)  # said, and gone
    yield "monitor"
    for name in ("Missions", "Trips"):
        open_page(page, name)
        yield f"flying-{name.lower()}"
    page.get_by_role("button", name="Stop: fly home").click()
    open_page(page, "Monitor")
    yield "stopping-monitor"
    until(lambda: station.phase == "stopped", "all are down")
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    yield "stopped-monitor"
    page.get_by_role("button", name="Resume").click()
    expect(row_of(page, "Mission 3")).to_contain_text("Completed", timeout=A_FLIGHT)
    expect(row_of(page, "Mission 1")).to_contain_text("Completed", timeout=A_FLIGHT)
    yield "over-monitor"
