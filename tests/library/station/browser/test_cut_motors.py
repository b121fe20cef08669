"""No drone is dropped by mistake: "Cut motors" takes a slide to its end, or a word, and Stop takes neither."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import start
from tests.library.station.browser.test_monitor import lists


@pytest.fixture
def aloft(serve: Serve, visit: Visit) -> Iterator[tuple[Station, Page, str]]:
    """A slow flight, and a drone in the air of which the card is open."""
    station = put_in(serve("drugs_distribution", "--speed", "1"))
    page = visit(station)
    start(page)
    until(lambda: station.in_the_air() != [], "one is in the air")
    drone = station.in_the_air()[0]
    lists(page, "Drones").get_by_role("button", name=drone).click()
    yield station, page, drone


def thumb(page: Page, drone: str) -> Locator:
    return page.get_by_role("slider", name=f"Slide to cut the motors of {drone}")


def slid(page: Page, drone: str, share: float) -> None:
    """Take the thumb a part of its way, and let go."""
    button, track = thumb(page, drone).bounding_box(), page.locator(".slide").bounding_box()
    assert button and track
    x, y = button["x"] + button["width"] / 2, button["y"] + button["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + share * (track["width"] - button["width"]), y, steps=6)
    page.mouse.up()


def test_clicks_and_half_a_slide_drop_nothing_and_a_whole_one_does(
    aloft: tuple[Station, Page, str],
) -> None:
    station, page, drone = aloft
    before = float(station.now()["state"]["time"])
    thumb(page, drone).dblclick()
    slid(page, drone, 0.6)
    expect(thumb(page, drone)).to_have_attribute("aria-valuenow", "0")  # it goes back
    until(lambda: station.now()["state"]["time"] > before + 1, "what was done has been dealt with")
    assert station.drone(drone)["status"] != "LOST"
    slid(page, drone, 1.0)
    until(lambda: station.drone(drone)["status"] == "LOST", "its motors are cut")
    expect(page.get_by_role("region", name=f"Drone {drone}")).to_contain_text("Lost")
    expect(page.get_by_role("button", name="Bring back")).to_be_visible()


@pytest.mark.long
def test_a_key_that_repeats_drops_nothing_and_the_arrow_pressed_to_the_end_does(
    aloft: tuple[Station, Page, str],
) -> None:
    station, page, drone = aloft
    thumb(page, drone).focus()
    for _ in range(30):
        page.keyboard.down("ArrowRight")  # held down: all but the first are repeats
    page.keyboard.up("ArrowRight")
    expect(thumb(page, drone)).to_have_attribute("aria-valuenow", "20")
    assert station.drone(drone)["status"] != "LOST"
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    until(lambda: station.drone(drone)["status"] == "LOST", "its motors are cut")


@pytest.mark.long
def test_a_word_does_it_for_voices_and_screen_readers_and_another_word_does_not(
    aloft: tuple[Station, Page, str],
) -> None:
    station, page, drone = aloft
    page.get_by_role("button", name="Cut motors by typing").click()
    word = page.get_by_label("Type “cut” and press Enter")
    word.fill("no")
    word.press("Enter")
    expect(word).to_have_value("")
    assert station.drone(drone)["status"] != "LOST"
    word.fill("cut")
    word.press("Enter")
    until(lambda: station.drone(drone)["status"] == "LOST", "its motors are cut")
