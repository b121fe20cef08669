"""The station as people find it: each page, in each phase, well and in trouble, one scene after another."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from playwright.sync_api import Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import (
    A_FLIGHT,
    missions_listed,
    open_page,
    pin_of,
    row_of,
    select_mission,
    settled,
    start,
)

Scenes = Callable[[Page, Station], Iterator[str]]

PAGES = ("Missions", "Trips", "Monitor", "Results", "History", "Map", "Help")

BY_A_PERSON = "Mission 3"
"""Its second trip releases what the first one has picked: whether that was done, only a person can know."""

SCRUB = """
(slider) => {
  slider.value = String(Number(slider.max) / 2);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}
"""


def empty(page: Page, station: Station) -> Iterator[str]:
    """Show every page before anything was drawn."""
    expect(page.get_by_role("button", name="Add the first mission")).to_be_visible()
    for name in PAGES[:5]:
        open_page(page, name)
        settled(page)
        yield f"empty-{name.lower()}"
    open_page(page, "Help")
    yield "help"
    page.get_by_role("button", name="A tour of one minute").click()
    page.get_by_role("button", name="Next").click()
    yield "tour"
    page.keyboard.press("Escape")
    open_page(page, "Map")
    expect(page.get_by_label("Name of Corridor")).to_be_visible()
    yield "map"


def drawn(page: Page, station: Station) -> Iterator[str]:
    """Show the plan of three missions, and what is expected of it."""
    put_in(station)
    open_page(page, "Missions")
    expect(missions_listed(page)).to_have_count(3)
    select_mission(page, "Mission 3")
    yield "missions"
    page.get_by_role("button", name="Saved plans").click()
    yield "saved-plans"
    page.keyboard.press("Escape")
    open_page(page, "Trips")
    pin_of(page, 1).click()  # opens its card
    yield "trips"
    page.get_by_role("button", name="Start 3 missions").click()
    expect(page.get_by_role("dialog")).to_contain_text("runs in virtual time")
    yield "preflight"
    page.keyboard.press("Escape")
    open_page(page, "Monitor")
    yield "drawn-monitor"


def flying(page: Page, station: Station) -> Iterator[str]:
    """Show a flight on which all goes well, to where one drone is lost and one mission asks."""
    start(page)
    open_page(page, "Monitor")
    expect(row_of(page, "Mission 3").locator(".trip-lines")).to_be_visible()  # it was selected
    until(lambda: trip_of(station, BY_A_PERSON) == 1, "the pills are on their way")
    station.tell("mishap", drone=drone_of(station, BY_A_PERSON), kind="uncertain")
    expect(page.get_by_text("3 missions started")).to_have_count(0)  # said, and gone
    yield "monitor"
    station.tell("mishap", drone=drone_of(station, "Mission 1"), kind="crash")
    lists(page, "Drones")
    flies = str(max(station.now()["drones"], key=lambda row: row["z"] or 0)["id"])
    page.get_by_role("tabpanel", name="Drones").get_by_role("button", name=flies).click()
    yield "drone-card"
    page.get_by_role("region", name=f"Drone {flies}").get_by_role("button", name="Close").click()
    lists(page, "Console")
    yield "console"
    for name in ("Missions", "Trips"):
        open_page(page, name)
        yield f"flying-{name.lower()}"
    open_page(page, "Monitor")
    lists(page, "Missions")
    expect(page.locator(".questions")).to_contain_text("Mission 3", timeout=A_FLIGHT)
    expect(row_of(page, "Mission 1")).to_contain_text("Failed", timeout=A_FLIGHT)
    yield "question"
    page.get_by_role("button", name="want attention").click()
    yield "attention"
    page.keyboard.press("Escape")


def broken(page: Page, station: Station) -> Iterator[str]:
    """Kill the station in flight, start it again, and go on."""
    station.kill()
    expect(page.get_by_role("alert").filter(has_text="Connection lost")).to_be_visible()
    yield "disconnected"
    station.start()
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    yield "restarted-monitor"
    page.get_by_role("button", name="Resume").click()
    until(lambda: station.phase == "flying", "it flies again")


def landed(page: Page, station: Station) -> Iterator[str]:
    """Land at once, where all are."""
    page.get_by_role("button", name="Stop: land now").click()
    expect(page.get_by_role("button", name="Resume")).to_be_visible(timeout=A_FLIGHT)
    yield "stopped-monitor"


def ended(page: Page, station: Station) -> Iterator[str]:
    """Go on, answer what is asked, and show how it all ended."""
    page.get_by_role("button", name="Resume").click()
    page.locator(".questions").get_by_role("button").nth(1).click(timeout=A_FLIGHT)
    for mission in ("Mission 2", "Mission 3"):
        expect(row_of(page, mission)).to_contain_text("Completed", timeout=A_FLIGHT)
    until(lambda: station.phase == "over", "all is over")
    yield "over-monitor"


def afterwards(page: Page, station: Station) -> Iterator[str]:
    """Show what the flight has brought, and the flights of the past."""
    open_page(page, "Results")
    expect(page.locator(".results .layer-row").first).to_be_visible()
    yield "ward-results"
    tabs = page.locator(".results").get_by_role("tablist")
    tabs.get_by_role("tab", name="Table").click()
    page.locator(".cell-button").first.click()
    expect(page.locator(".result-card")).to_be_visible()
    yield "results-table"
    page.locator(".result-card").get_by_role("button", name="Close").click()
    tabs.get_by_role("tab", name="Photos").click()
    yield "results-photos"
    tabs.get_by_role("tab").first.click()
    open_page(page, "History")
    flights = page.get_by_role("table", name="Flights").locator("tbody").get_by_role("button")
    expect(flights.first).to_be_visible()
    yield "flights"
    flights.first.click()
    slider = page.get_by_role("slider", name="Time")
    slider.evaluate(SCRUB)
    expect(page.locator(".replay .mission-entry").first).to_be_visible()
    expect(page.locator(".replay-waits")).to_have_count(0)
    yield "history"
    page.get_by_role("tablist", name="Of this flight").get_by_role("tab", name="Report").click()
    expect(page.get_by_role("article")).to_be_visible()
    yield "report"


def scenes(page: Page, station: Station) -> Iterator[str]:
    """Lead a page through everything there is to see; yields the name of what is on the screen."""
    for part in (empty, drawn, flying, broken, landed, ended, afterwards):
        yield from part(page, station)


def a_flight(page: Page, station: Station) -> Iterator[str]:
    """Lead a page through the same, but for what breaks, and for the end of a flight."""
    for part in (empty, drawn, flying, landed, afterwards):
        yield from part(page, station)


def heat(page: Page, station: Station) -> Iterator[str]:
    """Fly the missions of an app that measures an area, and show what they brought."""
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    open_page(page, "Results")
    expect(page.locator("image.heat")).to_have_count(1)
    expect(page.locator(".results .name").nth(9)).to_be_visible()  # names come after all else
    yield "results"


def pursuit(page: Page, station: Station) -> Iterator[str]:
    """Fly patrols to where one has seen somebody, who is followed; and open the form by which a person raises events."""
    start(page)
    open_page(page, "Monitor")
    lists(page, "Events")
    expect(page.locator(".event-entry .link").first).to_be_visible(timeout=A_FLIGHT)
    expect(page.locator(".pursuit").first).to_be_visible(timeout=A_FLIGHT)
    yield "events"
    page.get_by_text("Raise an event…").click()
    yield "raise"
    station.tell("stop", how="land")
    until(lambda: station.phase in ("stopped", "over"), "all have landed")
    open_page(page, "History")
    flights = page.get_by_role("table", name="Flights").locator("tbody").get_by_role("button")
    flights.first.click()
    slider = page.get_by_role("slider", name="Time")
    slider.evaluate(SCRUB.replace("/ 2", "- 5"))
    expect(page.locator(".replay .tracked").first).to_be_visible()
    yield "replayed-events"
    page.get_by_role("tablist", name="Of this flight").get_by_role("tab", name="Report").click()
    expect(page.get_by_role("article")).to_contain_text("Intruder")
    yield "report-of-events"


def lists(page: Page, name: str) -> None:
    """Open one of the lists beside the Monitor's map."""
    page.get_by_role("tablist", name="Lists beside the map").get_by_role("tab", name=name).click()


def trip_of(station: Station, name: str) -> int | None:
    """Return which trip a drone of the mission flies, from 0; None: it has no drone."""
    row = station.mission(name)
    current: int | None = row["current"]
    return current if row["drone"] else None


def drone_of(station: Station, name: str) -> str:
    """Wait until a mission has a drone in the air; return which."""
    up: list[str] = []

    def has() -> bool:
        found = station.mission(name)["drone"]
        up[:] = [id for id in station.in_the_air(1.0) if id == found]
        return bool(up)

    until(has, f"{name} flies")
    return up[0]
