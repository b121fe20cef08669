"""A user's way from an empty station to missions that are completed, stopped, gone on with, and flown anew."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, DONE, PLAN, names, targets
from tests.library.station.browser.steps import (
    card_of,
    drag,
    new_mission,
    row_of,
    sees_all,
    start,
)

NEAR = 0.15
"""Metres between where an action is dropped and where the plan has it."""


MOST_ACTIONS = 16
"""Presses of the mouse for the whole exercise, with the one on Start."""

COUNTED = """
addEventListener("pointerdown", () => {
  sessionStorage.presses = Number(sessionStorage.presses ?? 0) + 1;
}, true);
"""


def draw(page: Page) -> None:
    """Make the three missions with the mouse and their names."""
    for number, (mission, trips) in enumerate(PLAN.items()):
        if number:
            new_mission(page, mission)
        else:
            page.get_by_role("button", name="Add the first mission").click()
            expect(page.get_by_role("textbox", name="Name")).to_be_focused()
            page.keyboard.type(mission)
            page.keyboard.press("Enter")
            page.keyboard.press("Enter")  # sets its trips
        for count, trip in enumerate(trips, start=1):
            drag(page, trip.action, trip.at)
            if trip.action == "pick_item":  # its fields come by themselves
                expect(card_of(page, count).get_by_label("Item")).to_be_focused()
                page.keyboard.type(trip.item)
                page.keyboard.press("Tab")
                page.keyboard.type("8 g")


def test_three_missions_are_drawn_by_drag_and_drop_and_flown_to_their_end(
    serve: Serve, visit: Visit
) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    page = visit(station, prepare=lambda page: page.add_init_script(COUNTED))
    draw(page)
    wanted = [[pytest.approx(trip.at, abs=NEAR) for trip in trips] for trips in PLAN.values()]
    until(lambda: targets(station) == wanted, lambda: f"all is drawn: {targets(station)}")
    until(lambda: station.get("/api/plan")["problems"] == [], "it is sound")
    assert names(station) == list(PLAN)
    kinds = [[trip["action"] for trip in mission["trips"]] for mission in station.missions]
    assert kinds == [[trip.action for trip in trips] for trips in PLAN.values()]
    start(page)
    presses = page.evaluate("() => Number(sessionStorage.presses)")
    assert presses <= MOST_ACTIONS
    sees_all(page, "Completed")
    assert station.statuses() == COMPLETED
    assert station.done() == DONE
    expect(row_of(page, "Mission 3")).to_contain_text("4 of 4")
