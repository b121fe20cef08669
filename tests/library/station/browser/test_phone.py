"""On a phone everything fits, can be hit by a finger, and a swipe does what it does elsewhere."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, ViewportSize, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.layout import sideways, too_small, wider_than_the_screen
from tests.library.station.browser.scenes import PAGES
from tests.library.station.browser.steps import (
    action_called,
    add_mission,
    missions_listed,
    on_the_screen,
    open_page,
    settled,
)
from tests.library.station.browser.test_monitor import FIELD
from tests.library.station.browser.test_touch import middle, slide, target

PHONE = (390, 844)
SMALL: ViewportSize = {"width": 360, "height": 640}
NAMELESS = """
() => [...document.querySelectorAll("button")]
  .filter((one) => one.checkVisibility() && !one.textContent.trim() && !one.ariaLabel)
  .map((one) => one.outerHTML)
"""


def test_before_the_station_has_answered_no_button_is_shown_that_says_nothing(
    ward: Station, visit: Visit
) -> None:
    def never_answered(page: Page) -> None:
        page.route("**/api/app", lambda route: None)
        page.add_init_script("window.setInterval = () => 0")  # as it is first drawn

    page = visit(ward, size=PHONE, touch=True, prepare=never_answered)
    expect(page.get_by_role("heading", name="Pluto")).to_be_visible()
    settled(page)
    assert too_small(page, 24) == []
    assert page.evaluate(NAMELESS) == []
    expect(page.get_by_role("button", name="Resume")).to_have_count(0)


def test_long_names_and_large_graphs_fit_on_a_phone(serve: Serve, visit: Visit) -> None:
    station = serve("alfalfa", "--missions", str(FIELD))
    plan = station.get("/api/plan")
    for mission, name in zip(plan["missions"], ("Long " * 40, "Long" * 50), strict=False):
        mission["name"] = mission["trips"][0]["name"] = name.strip()
    assert station.put("/api/plan", plan_of(plan))[0] == 200
    page = visit(station, size=PHONE, touch=True)
    for name in PAGES:
        open_page(page, name)
        if name == "Missions":
            missions_listed(page).first.click()
        for width, height in ((SMALL["width"], SMALL["height"]), PHONE):
            page.set_viewport_size({"width": width, "height": height})
            settled(page)
            assert wider_than_the_screen(page) == 0, name
            assert sideways(page) == [], name


def plan_of(data: dict[str, Any]) -> dict[str, object]:
    """Return a plan as a page would send it."""
    return {"revision": data["revision"], "missions": data["missions"]}


@pytest.fixture
def drawn(ward: Station) -> Station:
    """A station with a plan that is longer than a phone."""
    put_in(ward)
    return ward


def test_a_swipe_over_the_map_moves_it_and_one_over_the_cards_scrolls_them(
    drawn: Station, visit: Visit
) -> None:
    page = visit(drawn, size=PHONE, touch=True)
    open_page(page, "Trips")
    page.get_by_label("Mission", exact=True).select_option(label="Mission 3 (4 trips)")
    page.get_by_role("button", name="Zoom in").click()
    page.get_by_role("button", name="Zoom in").click()
    before = on_the_screen(page, (9.0, 5.0))
    box = page.locator(".page:not([hidden]) .floor-picture").bounding_box()
    assert box is not None
    x, y = middle(box)
    slide(page, (x, y), (x - 40, y - 60))
    until(lambda: before[1] - on_the_screen(page, (9.0, 5.0))[1] > 40, "the map went along")
    rail = page.locator(".page:not([hidden]) .rail-body")
    below = rail.bounding_box()
    assert below is not None
    x, y = middle(below)
    slide(page, (x, y), (x, y - 90))
    until(lambda: rail.evaluate("one => one.scrollTop") > 50, "the cards are scrolled")
    assert page.evaluate("() => scrollY") == 0


def test_an_action_is_dropped_on_the_map_of_a_phone_by_a_finger(
    ward: Station, visit: Visit
) -> None:
    page = visit(ward, size=PHONE, touch=True)
    add_mission(page, "By hand")
    box = action_called(page, "take_photo").bounding_box()
    assert box is not None
    slide(page, middle(box), on_the_screen(page, (9.0, 6.5)))  # no named place is near
    until(lambda: target(ward) == pytest.approx([9.0, 6.5], abs=0.15), "it is where it was put")
