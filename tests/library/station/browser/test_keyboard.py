"""Without a mouse the same plan is drawn and flown, and all else is reached; the focus is never lost."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import DONE, PLAN, Place, targets
from tests.library.station.browser.steps import (
    ADD_MISSION,
    action_called,
    card_of,
    missions_listed,
    pin_of,
    sees_all,
)

PLACES = [[trip.at for trip in trips] for trips in PLAN.values()]

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


MOST_PRESSES = 70
"""Presses of keys for the whole exercise, the letters and numbers that are typed among them."""

COUNTED = """
addEventListener("keydown", ({ key }) => {
  if (key !== "Shift") sessionStorage.presses = Number(sessionStorage.presses ?? 0) + 1;
}, true);
"""


NUMBERS = {"measure": "1", "take_photo": "2", "pick_item": "3", "release_item": "4"}
"""The digits that take the actions in hand."""


def press_keys(page: Page, *keys: str) -> None:
    """Press keys, one after another."""
    for key in keys:
        page.keyboard.press(key)


class Putting:
    """Writes where the action in hand goes: down to a named place if that is shorter, else its numbers."""

    def __init__(self, page: Page, station: Station) -> None:
        self._page = page
        self._places = [(one["x"], one["y"]) for one in station.get("/api/map")["places"]]
        self._at = -1

    def __call__(self, place: Place) -> None:
        x, y = (f"{value:g}" for value in place)
        keys = [*x, "Tab", *y]
        if place in self._places:
            at = self._places.index(place)
            steps = ["ArrowDown"] * ((at - self._at) % len(self._places))
            if len(steps) < len(keys):
                keys, self._at = steps, at
        press_keys(self._page, *keys, "Enter")


@pytest.mark.long
def test_the_exercise_is_drawn_and_flown_by_few_keys_and_without_a_mouse(
    serve: Serve, visit: Visit
) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    page = visit(station, prepare=lambda page: page.add_init_script(COUNTED))
    put = Putting(page, station)
    x = page.get_by_role("textbox", name="x", exact=True)
    add(page)
    for index, trips in enumerate(PLAN.values()):
        if index:
            press_keys(page, "n")
            expect(page.get_by_label("Name of the mission")).to_be_focused()
            press_keys(page, "Enter")  # its name stays
        else:
            expect(page.get_by_role("textbox", name="Name")).to_be_focused()
            press_keys(page, "Enter", "Enter")  # on to its trips
        expect(action_called(page, "measure")).to_be_focused()
        in_hand = ""
        for number, trip in enumerate(trips, start=1):
            if trip.action != in_hand:
                press_keys(page, *(["Escape"] if in_hand else []), NUMBERS[trip.action])
            in_hand = trip.action
            expect(x).to_be_focused()
            put(trip.at)
            expect(pin_of(page, number)).to_be_visible()
            if trip.action == "pick_item":
                expect(card_of(page, number).get_by_label("Item")).to_be_focused()
                press_keys(page, *trip.item, "Tab", "8")
        press_keys(page, "Escape")
    until(lambda: targets(station) == PLACES, "the plan is kept")
    until(lambda: station.get("/api/plan")["problems"] == [], "the plan is sound")
    press_keys(page, "Shift+Tab")
    expect(page.get_by_role("button", name="Start 3 missions")).to_be_focused()
    with page.expect_request("**/api/start"):
        page.keyboard.down(" ")
    page.keyboard.up(" ")
    sees_all(page, "Completed")
    assert station.done() == DONE
    presses = page.evaluate("() => Number(sessionStorage.presses)")
    assert presses <= MOST_PRESSES


@pytest.mark.long
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


@pytest.mark.long
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
