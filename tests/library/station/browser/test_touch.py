"""On a tablet a finger does what the mouse does: actions are dragged onto the map, pins moved."""

from __future__ import annotations

import pytest
from playwright.sync_api import FloatRect, Locator, Page, expect

from tests.kit.browser import TABLET
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import DONE, PLAN
from tests.library.station.browser.steps import (
    action_called,
    add_mission,
    card_of,
    new_mission,
    on_the_screen,
    pin_of,
    sees_all,
)

PHONE = (390, 844)


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
    trips = station.missions[0]["trips"]
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


@pytest.mark.long  # a whole flight once more
def test_the_exercise_is_drawn_and_flown_by_fingers_on_a_phone(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    page = visit(station, size=PHONE, touch=True)
    for number, (mission, trips) in enumerate(PLAN.items()):
        if number:
            new_mission(page, mission)
        else:
            add_mission(page, mission)
        for count, trip in enumerate(trips, start=1):
            box = action_called(page, trip.action).bounding_box()
            assert box is not None
            slide(page, middle(box), on_the_screen(page, trip.at))
            expect(pin_of(page, count)).to_be_visible()
            if trip.action == "pick_item":
                card_of(page, count).get_by_label("Mass").fill("8 g")
    wanted = [len(trips) for trips in PLAN.values()]

    def is_drawn() -> bool:
        plan = station.get("/api/plan")
        drawn = [len(one["trips"]) for one in plan["missions"]]
        return plan["problems"] == [] and drawn == wanted

    until(is_drawn, "the plan is sound, and whole")
    for kept in station.missions:
        for drawn, trip in zip(kept["trips"], PLAN[kept["name"]], strict=True):
            assert drawn["target"][:2] == pytest.approx(trip.at, abs=0.3)
    hold(page, page.get_by_role("button", name="Start 3 missions"))
    sees_all(page, "Completed")
    assert station.done() == DONE
