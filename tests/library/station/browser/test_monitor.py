"""The page Monitor: what one sees of the missions, and what one can tell them while they fly."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, DONE, put_in
from tests.library.station.browser.steps import open_page, row_of, sees_all, start
from tests.paths import ROOT

FIELD = ROOT / "examples" / "alfalfa" / "missions.toml"
MISSIONS = ("North arc", "South-west arc", "South-east arc")

AS_SEEN = Path(__file__).with_name("as_seen.js").read_text(encoding="utf-8")


@pytest.fixture
def flying(serve: Serve, visit: Visit) -> Iterator[tuple[Station, Page]]:
    """The field of alfalfa, with all three missions under way."""
    station = serve("alfalfa", "--missions", str(FIELD), "--speed", "3")
    page = visit(station)
    start(page)
    open_page(page, "Monitor")
    for mission in MISSIONS:
        expect(row_of(page, mission)).to_be_visible()
    yield station, page


def lists(page: Page, name: str) -> Locator:
    """Open one of the lists beside the map."""
    page.get_by_role("tablist", name="Lists beside the map").get_by_role("tab", name=name).click()
    return page.get_by_role("tabpanel", name=name, exact=True)


def card(page: Page, drone: str) -> Locator:
    """Open the card of a drone by its line in the list."""
    lists(page, "Drones").get_by_role("button", name=drone).click()
    return page.get_by_role("region", name=f"Drone {drone}")


def opened(page: Page, name: str) -> None:
    """Open a mission's line."""
    opener = row_of(page, name).locator(".opener")
    opener.click()
    expect(opener).to_have_attribute("aria-expanded", "true")


def priorities(mission: dict[str, Any]) -> dict[str, int]:
    """Return the priority of each trip."""
    return {trip["name"]: trip["priority"] for trip in mission["trips"]}


def test_a_mission_is_paused_goes_on_and_is_cancelled_at_the_second_press(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    opened(page, "North arc")
    page.get_by_role("button", name="Pause", exact=True).click()
    expect(row_of(page, "North arc")).to_contain_text("Paused")
    page.get_by_role("button", name="Go on", exact=True).click()
    expect(row_of(page, "North arc")).not_to_contain_text("Paused")
    page.get_by_role("button", name="Cancel mission").click()
    assert station.mission("North arc")["status"] != "CANCELLED"
    page.get_by_role("button", name="Really cancel mission?").click()
    expect(row_of(page, "North arc")).to_contain_text("Cancelled")
    expect(row_of(page, "South-east arc")).not_to_contain_text("Cancelled")


@pytest.mark.long
def test_a_trip_is_weighed_anew_and_another_left_out_while_the_mission_flies(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    opened(page, "South-west arc")
    page.get_by_role("button", name="Raise the priority of trip C").click()
    arc = "South-west arc"
    until(lambda: priorities(station.mission(arc))["C"] == 1, "C is first")
    page.get_by_role("button", name="Skip trip D").click()
    until(lambda: station.mission(arc)["total"] == 3, "one less is flown")
    expect(page.get_by_role("button", name="Skip trip D")).to_have_count(0)


@pytest.mark.long
def test_the_graph_is_for_those_who_want_it_and_says_what_each_block_does(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    expect(page.get_by_role("tab", name="What the app does")).to_have_count(0)
    open_page(page, "Help")
    page.get_by_label("Show the graph of the app on the Monitor").check()
    open_page(page, "Monitor")
    opened(page, "South-east arc")
    graph = lists(page, "What the app does")
    shown = station.get("/api/app")["graph"]
    assert graph.get_by_role("button").count() == len(shown["blocks"])
    graph.get_by_role("button", name="allocate:").focus()
    expect(graph.locator(".caption")).to_contain_text(shown["kinds"]["DroneAllocator"])
    expect(graph.locator(".token.picked").first).to_have_text("3")


@pytest.mark.long
def test_missions_are_sifted_walked_through_by_keys_and_folded_away(
    flying: tuple[Station, Page],
) -> None:
    _, page = flying
    names = page.get_by_role("list", name="Missions").locator(".opener .called")
    which = page.get_by_role("group", name="Which missions")
    which.get_by_role("button", name="Ended 0").click()
    expect(names).to_have_count(0)
    which.get_by_role("button", name="All 3").click()
    expect(names).to_have_text(list(MISSIONS))
    row_of(page, MISSIONS[0]).locator(".opener").focus()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    expect(row_of(page, MISSIONS[1]).locator(".opener")).to_be_focused()
    expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()
    page.get_by_role("button", name="Hide the lists").click()
    page.reload()
    expect(page.get_by_role("button", name="Show the lists")).to_be_visible()
    expect(page.get_by_role("list", name="Missions")).to_be_hidden()


@pytest.mark.long
def test_drones_are_retired_brought_back_let_fall_and_joined_by_others(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    page.locator(".drone[data-status=BUSY] .drone-mark").first.focus()
    page.keyboard.press("Enter")  # opens its card, which leads to its mission
    its = page.locator(".drone-card").get_by_role("button", name="arc")
    name = its.inner_text()
    its.click()
    lists(page, "Missions")
    expect(row_of(page, name).locator(".opener")).to_have_attribute("aria-expanded", "true")
    its = card(page, "carrier2")
    its.get_by_role("button", name="Retire").click()
    expect(its).to_contain_text("Retired")
    assert station.drone("carrier2")["retired"]
    its.get_by_role("button", name="Bring back").click()
    until(lambda: not station.drone("carrier2")["retired"], "it is back")
    expect(its.get_by_role("button", name="Retire")).to_be_visible()
    drone = station.mission("North arc")["drone"]
    until(lambda: (station.drone(drone)["z"] or 0.0) > 0.3, "it is in the air")
    its = card(page, drone)
    its.get_by_text("Rehearse a mishap").click()
    its.get_by_role("button", name="It falls").click()
    until(lambda: station.drone(drone)["status"] == "LOST", "it is lost")
    drones = lists(page, "Drones")
    drones.get_by_text("Add a drone to this flight").click()
    drones.get_by_label("Its name").fill("late")
    drones.get_by_label("Home, x in metres").fill("1")
    drones.get_by_label("Home, y in metres").fill("1")
    drones.get_by_role("button", name="Let it join").click()
    expect(card(page, "late")).to_be_visible()
    assert station.get("/api/app")["drones"][-1]["home"] == [1.0, 1.0, 0.0]


def seen(page: Page) -> dict[str, dict[str, Any]]:
    """Return what list and map say of each drone, as a person reads them."""
    return {row["id"]: row for row in page.evaluate(AS_SEEN)}


def test_drones_that_are_called_home_are_seen_there_and_go_on_where_they_were(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve())
    page = visit(station)
    start(page)
    until(lambda: ("pick_item", "Mission 3/1/0") in station.done(), "the pills are picked")
    page.get_by_role("button", name="Stop: fly home").click()
    until(lambda: station.phase == "stopped", "all are down")
    open_page(page, "Monitor")
    lists(page, "Drones")
    said = re.compile(r"at [\d.]+; [\d.]+, seen \d+ s ago")
    until(
        lambda: all(said.search(row["why"]) for row in seen(page).values()),
        lambda: f"what is known is told with its age: {seen(page)}",
    )
    for drone in station.get("/api/app")["drones"]:
        shown = seen(page)[drone["id"]]
        assert (shown["x"], shown["y"]) == pytest.approx(drone["home"][:2], abs=0.15)
        assert shown["word"] == "On the ground"
        assert "On the ground" in shown["label"]
    page.get_by_role("button", name="Resume").click()
    lists(page, "Missions")
    sees_all(page, "Completed")
    assert station.statuses() == COMPLETED
    assert station.done() == DONE


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
