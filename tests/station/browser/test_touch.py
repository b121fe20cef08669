"""On a tablet a finger does what the mouse does: actions are dragged onto the map, pins moved."""

from __future__ import annotations

import pytest
from playwright.sync_api import FloatRect, Page

from tests.station.browser.conftest import TABLET, Serve, Visit
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import action_called, add_mission, on_the_screen, pin_of


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


def target(station: Station) -> list[float] | None:
    """Return where the only trip goes."""
    trips = station.get("/api/plan")["missions"][0]["trips"]
    return trips[0]["target"][:2] if trips else None


def test_a_finger_drags_an_action_onto_the_map_and_its_pin_elsewhere(
    serve: Serve, visit: Visit
) -> None:
    station = serve("drugs_distribution")
    page = visit(station, size=TABLET, touch=True)
    add_mission(page, "By hand")
    box = action_called(page, "take_photo").bounding_box()
    assert box is not None
    slide(page, middle(box), on_the_screen(page, (3.0, 7.5)))
    until(lambda: target(station) == pytest.approx([3.0, 7.5], abs=0.15), "it is where it was put")
    assert pin_of(page, 1).is_visible()
    slide(page, on_the_screen(page, (3.0, 7.5)), on_the_screen(page, (9.0, 2.5)))
    until(lambda: target(station) == pytest.approx([9.0, 2.5], abs=0.15), "its pin has moved")
