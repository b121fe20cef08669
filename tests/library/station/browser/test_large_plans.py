"""A plan of two thousand places is drawn by few elements, and each of its trips is reached as one of few is."""

from __future__ import annotations

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Visit
from tests.library.station.browser.exercise import Place
from tests.library.station.browser.steps import card_of, on_the_screen, open_page, pin_of
from tests.pages.looking import looked_at

pytestmark = pytest.mark.long
COLUMNS = 50
ROWS = 40
TRIPS = COLUMNS * ROWS

DOTS = """
() => [...document.querySelectorAll(".pins .dots:not(.chosen, .bad)")]
  .reduce((sum, one) => sum + one.getAttribute("d").split("M").length - 1, 0)
"""


def place(number: int) -> Place:
    """Return where a trip goes: in rows over the ward."""
    row, column = divmod(number - 1, COLUMNS)
    return round(0.5 + 0.34 * column, 2), round(0.5 + 0.22 * row, 2)


def survey() -> dict[str, Any]:
    """Return a mission of all of them, as a page would send it."""
    trips: list[dict[str, object]] = [
        {
            "key": f"trip-{number:04}",
            "action": "measure",
            "target": list(place(number)),
            "parameters": {},
            "item": None,
        }
        for number in range(1, TRIPS + 1)
    ]
    return {"key": "mission-0", "name": "Survey", "trips": trips}


def surveyed(ward: Station, visit: Visit) -> Page:
    """Open the trips of such a plan."""
    ward.plan([survey()])
    page = visit(ward)
    open_page(page, "Trips")
    page.get_by_role("combobox", name="Mission").select_option(index=1)
    expect(card_of(page, 1)).to_be_visible()
    return page


def head_of(page: Page, trip: int) -> Locator:
    """Return what opens the card of the trip with this number."""
    return page.locator(f'.trip-card[aria-posinset="{trip}"] .trip-head')


def test_all_places_are_drawn_and_the_page_stays_small_and_can_be_read_aloud(
    ward: Station, visit: Visit
) -> None:
    page = surveyed(ward, visit)
    assert page.evaluate(DOTS) == TRIPS
    assert page.evaluate("document.querySelectorAll('*').length") < TRIPS
    expect(head_of(page, 1)).to_be_visible()
    expect(card_of(page, 1)).to_have_attribute("aria-setsize", str(TRIPS))
    assert looked_at(page) == []


def test_a_dot_is_pressed_and_has_its_pin_then_which_is_moved(ward: Station, visit: Visit) -> None:
    page = surveyed(ward, visit)
    page.mouse.click(*on_the_screen(page, place(934)))
    expect(pin_of(page, 934)).to_have_class(re.compile("chosen"))
    expect(head_of(page, 934)).to_have_attribute("aria-expanded", "true")
    expect(head_of(page, 934)).to_be_in_viewport()
    page.mouse.move(*on_the_screen(page, place(934)))
    page.mouse.down()
    page.mouse.move(*on_the_screen(page, (9.0, 2.5)), steps=4)
    page.mouse.up()
    until(lambda: ward.missions[0]["trips"][933]["target"] == [9.0, 2.5], "it is moved")


def test_pins_are_there_where_they_have_room(ward: Station, visit: Visit) -> None:
    page = surveyed(ward, visit)
    expect(pin_of(page, 825)).to_have_count(0)
    page.mouse.move(*on_the_screen(page, place(825)))
    for _ in range(10):
        page.mouse.wheel(0, -200)
    expect(pin_of(page, 825)).to_be_in_viewport()
    page.get_by_role("button", name="Whole map").click()
    expect(pin_of(page, 825)).to_have_count(0)


def test_tab_goes_from_trip_to_trip_though_few_of_them_are_drawn(
    ward: Station, visit: Visit
) -> None:
    """On the map from pin to pin, and in the list past all that was drawn when the focus came."""
    page = surveyed(ward, visit)
    pin_of(page, 1).focus()
    for _ in range(4):
        page.keyboard.press("Tab")
    expect(pin_of(page, 5)).to_be_focused()
    head_of(page, 1).focus()
    for number in range(2, 80):
        page.keyboard.press("Tab")
        while not page.evaluate("document.activeElement.matches('.trip-head')"):
            page.keyboard.press("Tab")  # the fields of the one that is open
        expect(head_of(page, number)).to_be_focused()


def test_the_end_of_the_list_is_scrolled_to_and_a_trip_moves_up_in_it(
    ward: Station, visit: Visit
) -> None:
    page = surveyed(ward, visit)
    page.locator(".trips .rail-body").evaluate("rail => rail.scrollTo(0, rail.scrollHeight)")
    expect(head_of(page, TRIPS)).to_be_in_viewport()
    expect(head_of(page, 1)).to_have_count(0)
    grip = page.locator(f'.trip-card[aria-posinset="{TRIPS}"] .grip').bounding_box()
    above = head_of(page, TRIPS - 2).bounding_box()
    assert grip is not None
    assert above is not None
    page.mouse.move(grip["x"] + 5, grip["y"] + grip["height"] / 2)
    page.mouse.down()
    page.mouse.move(grip["x"] + 5, above["y"] + 4, steps=6)
    page.mouse.up()
    until(lambda: ward.missions[0]["trips"][-3]["key"] == f"trip-{TRIPS:04}", "it is moved")
