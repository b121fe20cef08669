"""The page Monitor: what one sees of the missions, and what one can tell them while they fly."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kill.lives import eventually
from tests.station.browser.conftest import Serve, Visit
from tests.station.browser.serving import Station, until
from tests.station.browser.steps import open_page, row_of, settled, start
from tests.station.browser.test_cut_motors import HELD

FIELD = Path(__file__).parents[3] / "examples" / "alfalfa" / "missions.toml"
MISSIONS = ("North arc", "South-west arc", "South-east arc")


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


def row(station: Station, kind: str, key: str, name: str) -> dict[str, Any]:
    """Return what the station shows of a mission or a drone."""
    return next(each for each in station.now()[kind] if each[key] == name)


def mission(station: Station, name: str) -> dict[str, Any]:
    return row(station, "missions", "name", name)


def panel(page: Page, name: str) -> Locator:
    return page.get_by_role("region", name=name, exact=True)


def opened(page: Page, name: str) -> None:
    """Open a mission's line."""
    opener = row_of(page, name).get_by_role("button")
    opener.click()
    expect(opener).to_have_attribute("aria-expanded", "true")


def dropped(station: Station, page: Page, buttons: Locator) -> str:
    """Hold a drone's button until it is lost, anew where its line moves away; return its name."""

    def tried() -> bool:
        button = buttons.first.element_handle()
        name = button.inner_text().split()[-1].rstrip("?")
        button.hover()
        page.mouse.down()
        settled(page)
        until(lambda: button.evaluate(HELD) == 0, "its second is over, or its line has moved away")
        page.mouse.up()
        if is_lost := eventually(lambda: row(station, "drones", "id", name)["status"] == "LOST", 3):
            lost.append(name)
        return is_lost

    lost: list[str] = []
    until(tried, "one is lost")
    return lost[0]


def holds(station: Station, name: str, what: Callable[[dict[str, Any]], bool]) -> None:
    until(lambda: what(mission(station, name)), f"{name} is so")


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
    assert mission(station, "North arc")["status"] != "CANCELLED"
    page.get_by_role("button", name="Really cancel mission?").click()
    expect(row_of(page, "North arc")).to_contain_text("Cancelled")
    expect(row_of(page, "South-east arc")).not_to_contain_text("Cancelled")


def test_a_trip_is_weighed_anew_and_another_left_out_while_the_mission_flies(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    opened(page, "South-west arc")
    page.get_by_role("button", name="Raise the priority of trip C").click()
    holds(station, "South-west arc", lambda one: ["C", 1] in [[t[0], t[4]] for t in one["trips"]])
    page.get_by_role("button", name="Skip trip D").click()
    holds(station, "South-west arc", lambda one: one["total"] == 3)
    expect(page.get_by_role("button", name="Skip trip D")).to_have_count(0)


def test_a_drone_is_retired_and_brought_back(flying: tuple[Station, Page]) -> None:
    station, page = flying
    drones = panel(page, "Drones")
    drones.get_by_role("button", name="Retire drone carrier2").click()
    expect(drones.get_by_role("listitem").filter(has_text="carrier2")).to_contain_text("Retired")
    assert row(station, "drones", "id", "carrier2")["retired"]
    drones.get_by_role("button", name="Bring back drone carrier2").click()
    until(lambda: not row(station, "drones", "id", "carrier2")["retired"], "it is back")
    expect(drones.get_by_role("button", name="Retire drone carrier2")).to_be_visible()


def test_the_graph_says_of_each_block_what_it_does_and_who_is_there(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    graph = panel(page, "What the app does")
    blocks = {block["name"]: block for block in station.get("/api/app")["graph"]["blocks"]}
    assert graph.get_by_role("button").count() == len(blocks) + 1  # and the one that folds it
    block = graph.get_by_role("button", name="allocate:")
    block.focus()
    expect(graph.locator(".caption")).to_contain_text(blocks["allocate"]["doc"])
    opened(page, "South-east arc")
    expect(graph.locator(".token.picked").first).to_have_text("3")


WAYS = """
async ([graph, ways]) => {
  const { finder } = await import("/pages/monitor.js");
  const way = finder(graph);
  return ways.map((given) => way(...given).map((edge) => edge.to).join(" "));
}
"""


def test_only_arrows_are_lit_that_the_mission_can_have_taken(serve: Serve, visit: Visit) -> None:
    """A mission is seen ten times a second only, and may pass several blocks in between."""
    station = serve("alfalfa")
    flight = ["watch", "timer"]
    expected = {
        ("COMPLETED", "end", "COMPLETED"): "first judge again end",
        ("COMPLETED", "allocate", "STANDBY"): "first judge allocate",
        ("COMPLETED", "wait", "STANDBY"): "first judge again wait",
        ("STANDBY", "allocate", "STANDBY"): "first allocate",
        ("FAILED", "allocate", "STANDBY"): "first retry allocate",
        ("FAILED", "end", "FAILED"): "first retry end",
        ("STANDBY", "end", "CANCELLED"): "",
    }
    ways = [[flight, *given] for given in expected]
    found = visit(station).evaluate(WAYS, [station.get("/api/app")["graph"], ways])
    assert found == list(expected.values())


def test_lines_are_found_in_the_console_and_all_are_downloaded(
    flying: tuple[Station, Page], tmp_path: Path
) -> None:
    _, page = flying
    console = panel(page, "Console")
    expect(console.get_by_role("log")).to_contain_text("South-east arc")
    console.get_by_label("Find text").fill("launched")
    expect(console.get_by_role("log")).to_contain_text("trip A launched")
    expect(console.get_by_role("log")).not_to_contain_text("completed")
    console.get_by_label("Of which mission").select_option("North arc")
    expect(console.get_by_role("log")).not_to_contain_text("South")
    with page.expect_download() as download:
        console.get_by_role("button", name="Download").click()
    assert download.value.suggested_filename == "console.txt"
    download.value.save_as(tmp_path / "console.txt")
    assert "South-east arc" in (tmp_path / "console.txt").read_text()


def test_a_photo_is_shown_with_where_it_was_taken(flying: tuple[Station, Page]) -> None:
    _, page = flying
    results = panel(page, "Results")
    photo = results.get_by_role("listitem").get_by_role("button").first
    photo.focus()
    expect(page.locator(".layer.photo-frame rect")).to_have_count(1)
    expect(results.get_by_role("button", name="Photos")).to_have_attribute("aria-pressed", "true")


def test_missions_are_sifted_and_sorted_and_walked_through_by_keys(
    flying: tuple[Station, Page],
) -> None:
    _, page = flying
    table = page.get_by_role("table", name="Missions")
    names = table.locator(".entry:visible .opener .called")
    which = page.get_by_role("group", name="Which missions")
    which.get_by_role("button", name="Failed 0").click()
    expect(names).to_have_count(0)
    which.get_by_role("button", name="All 3").click()
    expect(names).to_have_text(list(MISSIONS))
    head = table.get_by_role("columnheader", name="Mission")
    head.get_by_role("button").click()
    expect(head).to_have_attribute("aria-sort", "descending")
    expect(names).to_have_text(list(reversed(MISSIONS)))
    row_of(page, MISSIONS[2]).get_by_role("button").focus()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    expect(row_of(page, MISSIONS[1]).get_by_role("button")).to_be_focused()
    expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()


def test_a_panel_that_was_folded_stays_so(flying: tuple[Station, Page]) -> None:
    _, page = flying
    page.get_by_role("button", name="What the app does").click()
    expect(page.locator(".graph-view")).to_be_hidden()
    page.reload()
    expect(page.get_by_role("button", name="What the app does")).to_have_attribute(
        "aria-expanded", "false"
    )
    expect(page.get_by_role("button", name="Console")).to_have_attribute("aria-expanded", "true")


def test_motors_are_cut_while_the_button_is_held_and_the_lost_drone_is_brought_back(
    flying: tuple[Station, Page],
) -> None:
    station, page = flying
    drones = panel(page, "Drones")
    who = dropped(station, page, drones.get_by_role("button", name="cut motors of"))
    expect(drones.get_by_role("listitem").filter(has_text=who)).to_contain_text("Lost")
    assert row(station, "drones", "id", who)["z"] == 0
    expect(panel(page, "Console")).to_contain_text(f"{who}'s motors were cut")
    drones.get_by_role("button", name=f"Bring back drone {who}").click()
    until(lambda: row(station, "drones", "id", who)["status"] != "LOST", "it is back")
    expect(drones.get_by_role("button", name=f"Retire drone {who}")).to_be_visible()
