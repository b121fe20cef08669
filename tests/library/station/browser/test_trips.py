"""Trips are drawn on the floor plan: pins, their cards and the plan always say the same."""

from __future__ import annotations

import re
from functools import partial
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import Place
from tests.library.station.browser.steps import (
    add_mission,
    card_of,
    drag,
    on_the_screen,
    pin_of,
)

WALL = (6.0, 8.0)
"""In the first no-fly area of the ward."""


def trips(station: Station) -> list[dict[str, Any]]:
    """Return the trips of the only mission, as the station has them."""
    return list(station.missions[0]["trips"])


def has(station: Station, count: int) -> bool:
    """Return whether the only mission has so many trips."""
    return len(trips(station)) == count


def targets(station: Station) -> list[list[float]]:
    """Return where they go."""
    return [trip["target"] for trip in trips(station)]


def take(page: Page, place: Place) -> None:
    """Press the mouse on the map."""
    page.mouse.move(*on_the_screen(page, place))
    page.mouse.down()


def drawn(station: Station, visit: Visit, *actions: tuple[str, Place]) -> tuple[Station, Page]:
    """Draw a mission of these trips, and nothing else."""
    station.plan([])
    page = visit(station)
    add_mission(page, "Drawn")
    for count, (action, place) in enumerate(actions, 1):
        drag(page, action, place)
        until(partial(has, station, count), "the trip is kept")
    return station, page


@pytest.mark.long
def test_a_trip_does_something_on_its_way_as_its_card_says(serve: Serve, visit: Visit) -> None:
    station, page = drawn(serve("aerial_mapping"), visit, ("Take photo", (3.0, 4.0)))
    page.get_by_label("On the way").select_option("take_photo")
    often = page.get_by_label("How often: a length or a time")
    expect(often).to_have_value("1 m")
    often.fill("often")
    expect(card_of(page, 1).locator("[data-field=along] .problem")).to_contain_text("2 m")
    often.fill("2 m")
    until(lambda: along(station) == {"action": "take_photo", "every": "2 m"}, "it is kept")
    expect(card_of(page, 1).locator("[data-field=along] .problem")).to_be_hidden()
    page.get_by_label("On the way").select_option("")
    until(lambda: along(station) is None, "it is taken away")


def along(station: Station) -> object:
    """Return what the only trip does on its way."""
    return trips(station)[0].get("along")


@pytest.mark.long
def test_the_arrow_keys_move_a_pin_and_delete_removes_it_and_undo_brings_it_back(
    ward: Station, visit: Visit
) -> None:
    station, page = drawn(ward, visit, ("take_photo", (3.0, 7.5)), ("measure", (9.0, 2.5)))
    pin_of(page, 1).focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowDown")
    until(lambda: targets(station)[0] == [3.1, 6.5], "it has moved")
    before = trips(station)
    page.keyboard.press("Delete")
    until(lambda: len(trips(station)) == 1, "it is gone")
    page.locator(".notices").get_by_role("button", name="Undo").click()
    until(lambda: trips(station) == before, "it is back where it was")


def test_a_pin_over_a_no_fly_area_says_so_while_it_is_still_held(
    ward: Station, visit: Visit
) -> None:
    station, page = drawn(ward, visit, ("take_photo", (3.0, 7.5)))
    take(page, (3.0, 7.5))
    page.mouse.move(*on_the_screen(page, WALL), steps=5)
    expect(pin_of(page, 1)).to_have_accessible_name(re.compile("In a no-fly area"))
    expect(card_of(page, 1)).to_contain_text("In a no-fly area")
    page.mouse.move(*on_the_screen(page, (-0.3, 8.0)), steps=5)
    expect(pin_of(page, 1)).to_have_accessible_name(re.compile("Outside the map"))
    assert targets(station) == [[3.0, 7.5]], "nothing is kept before it is let go"
    page.keyboard.press("Escape")
    expect(pin_of(page, 1)).not_to_have_accessible_name(re.compile("Problem"))
    page.mouse.up()
    assert targets(station) == [[3.0, 7.5]]


@pytest.mark.long
def test_several_pins_are_selected_by_a_rectangle_and_go_together(
    ward: Station, visit: Visit
) -> None:
    """Moved by mouse and keys, duplicated and deleted, which is one step."""
    places = ((3.0, 6.9), (4.0, 6.9), (9.0, 5.0))
    station, page = drawn(ward, visit, *(("measure", place) for place in places))
    page.keyboard.down("Shift")
    take(page, (2.0, 7.5))
    page.mouse.move(*on_the_screen(page, (5.0, 6.2)), steps=4)
    page.mouse.up()
    page.keyboard.up("Shift")
    expect(page.get_by_text("2 trips are selected")).to_be_visible()
    take(page, (3.0, 6.9))
    page.mouse.move(*on_the_screen(page, (3.0, 5.4)), steps=4)
    page.mouse.up()
    until(lambda: targets(station) == [[3.0, 5.4], [4.0, 5.4], [9.0, 5.0]], "both are moved")
    page.keyboard.press("ArrowRight")
    until(lambda: targets(station)[:2] == [[3.1, 5.4], [4.1, 5.4]], "both are moved again")
    page.get_by_role("button", name="Duplicate").click()
    until(lambda: len(trips(station)) == 5, "there are two more")
    assert targets(station)[2:4] == [[3.6, 5.4], [4.6, 5.4]]
    page.get_by_role("group", name="Selected trips").get_by_role("button", name="Delete").click()
    until(lambda: len(trips(station)) == 3, "they are gone")
    page.keyboard.press("Control+z")
    until(lambda: len(trips(station)) == 5, "they are back, both by one step")


@pytest.mark.long
def test_a_row_and_a_grid_are_drawn_over_the_map_and_added_at_once(
    ward: Station, visit: Visit
) -> None:
    station, page = drawn(ward, visit)
    page.get_by_role("button", name="A row of trips").click()
    take(page, (2.0, 6.9))
    page.mouse.move(*on_the_screen(page, (5.0, 6.9)), steps=4)
    page.mouse.up()
    form = page.get_by_role("form", name="A row of trips")
    form.get_by_label("Trips").fill("4")
    form.get_by_role("button", name="Add 4 trips").click()
    until(lambda: len(trips(station)) == 4, "the row is kept")
    assert [x for x, _ in targets(station)] == [2.0, 3.0, 4.0, 5.0]
    page.get_by_role("button", name="A grid of trips").click()
    form = page.get_by_role("form", name="A grid of trips")
    form.get_by_label("Action").select_option("take_photo")
    for name, value in (("From x", "7"), ("From y", "4.5"), ("To x", "9"), ("To y", "5.5")):
        form.get_by_label(name).fill(value)
    form.get_by_label("Columns").fill("3")
    form.get_by_label("Rows").fill("2")
    form.get_by_role("button", name="Add 6 trips").click()
    until(lambda: len(trips(station)) == 10, "the grid is kept")
    assert targets(station)[4:8] == [[7, 4.5], [8, 4.5], [9, 4.5], [9, 5.5]]
    page.get_by_role("button", name=re.compile("^Undo ")).click()
    until(lambda: len(trips(station)) == 4, "it goes at once, too")


def test_an_area_is_swept_on_the_way(serve: Serve, visit: Visit) -> None:
    """The tool says how many photos that makes, in what time; each lane is a trip from its source to its target."""
    station = serve("aerial_mapping")
    station.plan([])
    page = visit(station)
    add_mission(page, "Drawn")
    page.get_by_role("button", name="A sweep of an area").click()
    panel = page.locator(".tool-panel")
    for name, value in (("From x", "4"), ("From y", "3"), ("To x", "10"), ("To y", "6")):
        panel.get_by_label(name, exact=True).fill(value)
        panel.get_by_label(name, exact=True).press("Tab")
    panel.get_by_label("Between lanes").fill("1.5 m")
    expect(panel).to_contain_text("8 trips with 8 places")
    panel.get_by_label("It is done").select_option(label="On the way")
    expect(panel).to_contain_text("2 trips with 8 places")
    expect(panel).to_contain_text("One drone takes about")
    panel.get_by_role("button", name="Add 2 trips").click()
    until(partial(has, station, 2), "they are kept")
    for trip, ends in zip(trips(station), ([4.75, 9.25], [9.25, 4.75]), strict=True):
        assert [trip["source"][0], trip["target"][0]] == ends
        assert trip["along"] == {"action": "take_photo", "every": "1.5 m"}
    expect(page.locator(".problem:visible")).to_have_count(0)
