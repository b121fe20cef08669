"""On a phone everything fits, can be hit by a finger, and a swipe does what it does elsewhere."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, ViewportSize, expect

from tests.station.browser.axe import violations
from tests.station.browser.conftest import Serve, Visit
from tests.station.browser.exercise import put_in
from tests.station.browser.layout import covered, cut_off, too_small, wider_than_the_screen
from tests.station.browser.scenes import PAGES, scenes
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import (
    action_called,
    add_mission,
    missions_listed,
    on_the_screen,
    open_page,
    settled,
)
from tests.station.browser.test_monitor import FIELD
from tests.station.browser.test_touch import middle, slide, target

PHONE = (390, 844)
SMALL: ViewportSize = {"width": 360, "height": 640}
INSIDE = """
() => [...document.querySelectorAll(
  ".page:not([hidden]) .inside, .graph-view, .mission-list, .trip-cards")]
  .filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.scrollWidth} in ${one.clientWidth}: ${one.className}`)
"""

NAMELESS = """
() => [...document.querySelectorAll("button")]
  .filter((one) => one.checkVisibility() && !one.textContent.trim())
  .map((one) => one.outerHTML)
"""


@pytest.mark.long  # all phases of a flight, as on a laptop
def test_every_page_in_every_phase_fits_on_a_phone(serve: Serve, visit: Visit) -> None:
    """Nothing scrolls to the side, neither the page nor a list in it; 24 pixels can be hit."""
    station = serve("drugs_distribution", "--speed", "5")
    page = visit(station, size=PHONE, touch=True)
    wrong: dict[str, list[str]] = {}
    for scene in scenes(page, station):
        settled(page)
        inside: list[str] = page.evaluate(INSIDE)
        small = [
            one for one in too_small(page, 24) if "block" not in one
        ]  # of the graph: a picture
        found = [*violations(page), *covered(page), *cut_off(page), *inside, *small]
        wrong[scene] = [*found, *too_wide(wider_than_the_screen(page))]
        page.set_viewport_size(SMALL)
        settled(page)
        wrong[scene] += [*too_wide(wider_than_the_screen(page)), *page.evaluate(INSIDE)]
        page.set_viewport_size({"width": PHONE[0], "height": PHONE[1]})
    assert {where: said for where, said in wrong.items() if said} == {}


def test_before_the_station_has_answered_no_button_is_shown_that_says_nothing(
    ward: Station, visit: Visit
) -> None:
    def never_answered(page: Page) -> None:
        page.route("**/api/app", lambda route: None)
        page.add_init_script("window.setInterval = () => 0")  # as it is first drawn

    page = visit(ward, size=PHONE, touch=True, prepare=never_answered)
    expect(page.get_by_role("heading", name="Ground station")).to_be_visible()
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
            assert page.evaluate(INSIDE) == [], name


def plan_of(data: dict[str, Any]) -> dict[str, object]:
    """Return a plan as a page would send it."""
    return {"revision": data["revision"], "missions": data["missions"]}


def too_wide(pixels: int) -> list[str]:
    return [f"{pixels} pixels wider than the screen"] if pixels else []


@pytest.fixture
def drawn(ward: Station) -> Station:
    """A station with a plan that is longer than a phone."""
    revision = ward.get("/api/plan")["revision"]
    assert ward.put("/api/plan", {"revision": revision, "missions": []})[0] == 200
    put_in(ward)
    return ward


def test_a_swipe_over_the_map_scrolls_the_page_and_moves_the_map_when_it_is_near(
    drawn: Station, visit: Visit
) -> None:
    page = visit(drawn, size=PHONE, touch=True)
    open_page(page, "Trips")
    page.get_by_label("Mission", exact=True).select_option(label="Mission 3 (4 trips)")
    x, y = on_the_screen(page, (9.0, 5.0))
    slide(page, (x, y), (x, y - 200))
    until(lambda: page.evaluate("() => scrollY") > 50, "the page is scrolled")
    page.get_by_role("button", name="Zoom in").click()
    page.get_by_role("button", name="Zoom in").click()
    page.evaluate("() => scrollTo(0, 0)")
    before = on_the_screen(page, (9.0, 5.0))
    slide(page, (x, y), (x + 40, y + 60))
    until(lambda: on_the_screen(page, (9.0, 5.0))[1] - before[1] > 40, "the map went along")
    assert page.evaluate("() => scrollY") == 0


def test_an_action_is_dropped_on_the_map_of_a_phone_by_a_finger(
    ward: Station, visit: Visit
) -> None:
    revision = ward.get("/api/plan")["revision"]
    assert ward.put("/api/plan", {"revision": revision, "missions": []})[0] == 200
    page = visit(ward, size=PHONE, touch=True)
    add_mission(page, "By hand")
    box = action_called(page, "take_photo").bounding_box()
    assert box is not None
    slide(page, middle(box), on_the_screen(page, (3.0, 8.0)))
    until(lambda: target(ward) == pytest.approx([3.0, 8.0], abs=0.15), "it is where it was put")
