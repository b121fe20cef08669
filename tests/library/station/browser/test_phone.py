"""Fingers do what the mouse does; on a phone everything fits, and can be hit."""

from __future__ import annotations

import pytest
from playwright.sync_api import FloatRect, Locator, Page, ViewportSize

from tests.kit.browser import PHONE
from tests.kit.layout import sideways, wider_than_the_screen
from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import targets
from tests.library.station.browser.steps import (
    action_called,
    add_mission,
    missions_listed,
    on_the_screen,
    open_page,
    sees_all,
    settled,
)
from tests.library.station.browser.test_monitor import FIELD
from tests.pages.scenes import PAGES

pytestmark = pytest.mark.long

SMALL: ViewportSize = {"width": 360, "height": 640}


def test_long_names_and_large_graphs_fit_on_a_phone(serve: Serve, visit: Visit) -> None:
    station = serve("alfalfa", "--missions", str(FIELD))
    missions = station.missions
    for mission, name in zip(missions, ("Long " * 40, "Long" * 50), strict=False):
        mission["name"] = mission["trips"][0]["name"] = name.strip()
    station.plan(missions)
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


def slide(page: Page, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Put a finger down, move it, and lift it, as the browser hears it from a screen."""
    finger = page.context.new_cdp_session(page)
    steps = 8
    for number in range(steps + 1):
        x = start[0] + (end[0] - start[0]) * number / steps
        y = start[1] + (end[1] - start[1]) * number / steps
        kind = "touchMove" if number else "touchStart"
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def middle(box: FloatRect) -> tuple[float, float]:
    """Return the middle of a box."""
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def hold(page: Page, what: Locator) -> None:
    """Put a finger on something, and leave it there until the flight is asked for."""
    box = what.bounding_box()
    assert box is not None
    x, y = middle(box)
    finger = page.context.new_cdp_session(page)
    with page.expect_request("**/api/start"):
        finger.send(
            "Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]}
        )
    finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


def test_a_trip_is_drawn_moved_and_flown_by_a_finger(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    page = visit(station, size=PHONE, touch=True)
    add_mission(page, "By hand")
    box = action_called(page, "take_photo").bounding_box()
    assert box is not None
    slide(page, middle(box), on_the_screen(page, (3.0, 7.5)))
    until(lambda: targets(station) == [[pytest.approx((3.0, 7.5), abs=0.3)]], "it is there")
    slide(page, on_the_screen(page, (3.0, 7.5)), on_the_screen(page, (9.0, 2.5)))
    until(lambda: targets(station) == [[pytest.approx((9.0, 2.5), abs=0.3)]], "it has moved")
    hold(page, page.get_by_role("button", name="Start 1 mission"))
    sees_all(page, "Completed", ("By hand",))
