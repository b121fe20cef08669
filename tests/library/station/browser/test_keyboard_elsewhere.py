"""What is looked at, answered and set is reached by the keyboard alone, and the focus is never lost."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.test_keyboard import press, tab_to

pytestmark = pytest.mark.long


def page_by_keys(page: Page, name: str) -> None:
    """Go to a page by the arrow keys of its tabs."""
    bar = page.get_by_role("tablist", name="Pages")
    tab_to(page, bar.get_by_role("tab", selected=True))
    wanted = bar.get_by_role("tab", name=name)
    for _ in range(7):
        if wanted.get_attribute("aria-selected") == "true":
            break
        page.keyboard.press("ArrowRight")
        expect(bar.get_by_role("tab", selected=True)).to_be_focused()
    expect(wanted).to_be_focused()


def test_what_is_expected_and_what_wants_attention_is_opened_and_closed_by_keys(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve("drugs_distribution"))
    page = visit(station)
    begin = page.get_by_role("button", name="Start 3 missions")
    tab_to(page, begin)
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog")
    expect(dialog).to_be_focused()
    page.keyboard.press("Escape")
    expect(begin).to_be_focused()
    station.tell("start")
    until(lambda: station.now()["alerts"] != [], "something was found")
    bell = page.get_by_role("button", name="attention")
    tab_to(page, bell)
    page.keyboard.press("Enter")
    expect(dialog).to_be_focused()
    tab_to(page, dialog.get_by_role("button", name="I have seen it").first)
    page.keyboard.press("Enter")
    until(lambda: any(one["by"] is not None for one in station.now()["alerts"]), "it was seen")
    expect(dialog).to_be_focused()  # though the button has gone
    page.keyboard.press("Escape")
    expect(bell).to_be_focused()


def test_a_result_a_replay_and_a_setting_are_reached_by_keys(serve: Serve, visit: Visit) -> None:
    station = put_in(serve("drugs_distribution", "--speed", "60"))
    station.tell("start")
    until(lambda: station.phase == "over", "the flight is over")
    page = visit(station)
    page_by_keys(page, "Results")
    results = page.get_by_role("tabpanel", name="Results")
    tab_to(page, results.get_by_role("tab", name="Layers"))
    page.keyboard.press("ArrowRight")
    expect(results.get_by_role("tab", name="Table")).to_be_focused()
    tab_to(page, page.get_by_role("table", name="Results"))
    page.keyboard.press("ArrowDown")
    expect(page.locator(".result-card")).to_be_visible()
    page_by_keys(page, "History")
    flights = page.get_by_role("table", name="Flights").locator("tbody").get_by_role("button")
    tab_to(page, flights.first)
    page.keyboard.press("Enter")
    slider = page.get_by_role("slider", name="Time")
    tab_to(page, slider)
    page.keyboard.press("ArrowRight")
    expect(slider).to_have_value("5")
    page_by_keys(page, "Help")
    tab_to(page, page.get_by_label("Language"))
    page.keyboard.type("Ital")
    expect(page.get_by_role("tab", name="Aiuto")).to_be_visible()


def test_a_place_is_drawn_by_its_numbers_and_taken_away_by_keys(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution")
    page = visit(station)
    page_by_keys(page, "Map")
    press(page, "Add places")
    tab_to(page, page.get_by_label("x in metres"))
    page.keyboard.type("4")
    page.keyboard.press("Tab")
    page.keyboard.type("2,5")
    page.keyboard.press("Enter")
    until(lambda: [4, 2.5] in places(station), "the place is kept")
    name = next(one["name"] for one in station.get("/api/map")["places"] if one["x"] == 4)
    press(page, f"Remove {name}")
    until(lambda: [4, 2.5] not in places(station), "it is gone")


def places(station: Station) -> list[list[float]]:
    return [[one["x"], one["y"]] for one in station.get("/api/map")["places"]]
