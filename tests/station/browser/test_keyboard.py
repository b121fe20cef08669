"""Without a mouse the same plan is drawn, and flown."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.station.browser.conftest import Serve, Visit
from tests.station.browser.exercise import DONE, PLAN, Place
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import (
    ADD_MISSION,
    action_called,
    card_of,
    missions_listed,
    sees_all,
)

PLACES = {mission: [trip.at for trip in trips] for mission, trips in PLAN.items()}

FAR = 150
"""Presses of Tab: what has not come by then never will."""


def tab_to(page: Page, wanted: Locator) -> None:
    """Press Tab until this has the focus, and see that it shows."""
    for _ in range(FAR):
        if wanted.evaluate("element => element === document.activeElement"):
            shown = wanted.evaluate(
                "element => { const style = getComputedStyle(element);"
                " return style.outlineStyle !== 'none' || style.boxShadow !== 'none'; }"
            )
            assert shown, "the focus is not seen"
            return
        page.keyboard.press("Tab")
    raise AssertionError(f"Tab never comes to {wanted}")


def press(page: Page, name: str) -> None:
    """Go to a button and press it."""
    tab_to(page, page.get_by_role("button", name=name, exact=True).first)
    page.keyboard.press("Enter")


def add(page: Page) -> None:
    """Add a mission: the first one where the page says what to do first."""
    tab_to(page, page.get_by_role("button", name=ADD_MISSION).first)
    page.keyboard.press("Enter")


def go_to(page: Page, name: str) -> None:
    """Go to a page by the arrow keys of its tabs."""
    tab_to(page, page.get_by_role("tab", selected=True))
    for _ in range(8):
        if page.get_by_role("tab", selected=True).inner_text() == name:
            return
        page.keyboard.press("ArrowRight")
    raise AssertionError(f"no tab is called {name}")


def drawn(station: Station) -> dict[str, list[Place]]:
    """Return where the trips of each mission go, as the station keeps it."""
    return {
        mission["name"]: [tuple(trip["target"][:2]) for trip in mission["trips"]]
        for mission in station.get("/api/plan")["missions"]
    }


@pytest.mark.long  # a whole flight once more
def test_the_exercise_is_drawn_and_flown_without_a_mouse(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    page = visit(station)
    for mission, trips in PLAN.items():
        go_to(page, "Missions")
        add(page)
        page.keyboard.type(mission)
        page.keyboard.press("Enter")  # goes on to its trips
        page.keyboard.press("Enter")
        for number, trip in enumerate(trips, start=1):
            tab_to(page, action_called(page, trip.action))
            page.keyboard.press("Enter")
            page.keyboard.type(str(trip.at[0]))
            page.keyboard.press("Tab")
            page.keyboard.type(str(trip.at[1]))
            page.keyboard.press("Enter")
            if trip.action == "pick_item":
                card = card_of(page, number)
                tab_to(page, card.get_by_label("Item").first)
                page.keyboard.type(trip.item)
                tab_to(page, card.get_by_label("Mass"))
                page.keyboard.type("8")
    until(lambda: drawn(station) == PLACES, "the plan is kept")
    until(lambda: station.get("/api/plan")["problems"] == [], "the plan is sound")
    press(page, "Start 3 missions")
    sees_all(page, "Completed")
    assert station.done() == DONE


def test_missions_change_places_and_go_by_keys_and_come_back(serve: Serve, visit: Visit) -> None:
    station = serve("drugs_distribution")
    page = visit(station)
    for name in ("One", "Two", "Three"):
        add(page)
        page.keyboard.type(name)
    expect(missions_listed(page)).to_have_text(["One", "Two", "Three"])
    tab_to(page, page.get_by_role("listbox", name="Missions"))
    page.keyboard.press("Alt+ArrowUp")
    expect(missions_listed(page)).to_have_text(["One", "Three", "Two"])
    page.keyboard.press("Delete")
    expect(missions_listed(page)).to_have_text(["One", "Two"])
    press(page, "Undo")
    expect(missions_listed(page)).to_have_text(["One", "Three", "Two"])
