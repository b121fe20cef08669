"""The Monitor shows each drone as it is: place, status and reason; what is not known is shown as unknown."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.kit.station import until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import COMPLETED, DONE, put_in
from tests.library.station.browser.steps import open_page, sees_all, start

AS_SEEN = Path(__file__).with_name("as_seen.js").read_text(encoding="utf-8")

NEAR = 0.15
"""Metres: some pixels."""


def seen(page: Page) -> dict[str, dict[str, Any]]:
    """Return what list and map say of each drone, as a person reads them."""
    return {row["id"]: row for row in page.evaluate(AS_SEEN)}


def open_drones(page: Page) -> None:
    """Open the Monitor's list of drones."""
    open_page(page, "Monitor")
    page.get_by_role("tab", name="Drones").click()


def card_of(page: Page, drone: str) -> Locator:
    """Open a drone's card."""
    page.get_by_role("listitem").get_by_role("button", name=drone).click()
    return page.get_by_role("region", name=f"Drone {drone}")


def test_drones_that_are_called_home_are_seen_there_and_go_on_where_they_were(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve())
    page = visit(station)
    start(page)
    until(lambda: ("pick_item", "Mission 3/1/0") in station.done(), "the pills are picked")
    page.get_by_role("button", name="Stop: fly home").click()
    until(lambda: station.phase == "stopped", "all are down")
    open_drones(page)
    said = re.compile(r"at [\d.]+; [\d.]+, seen \d+ s ago")
    until(
        lambda: all(said.search(row["why"]) for row in seen(page).values()),
        lambda: f"what is known is told with its age: {seen(page)}",
    )
    for drone in station.get("/api/app")["drones"]:
        shown = seen(page)[drone["id"]]
        assert (shown["x"], shown["y"]) == pytest.approx(drone["home"][:2], abs=NEAR)
        assert shown["word"] == "On the ground"
        assert "On the ground" in shown["label"]
    page.get_by_role("button", name="Resume").click()
    beside = page.get_by_role("tablist", name="Lists beside the map")
    beside.get_by_role("tab", name="Missions").click()
    sees_all(page, "Completed")
    assert station.statuses() == COMPLETED
    assert station.done() == DONE


def test_with_every_drone_lost_no_start_is_offered_and_one_that_is_brought_back_is_unknown(
    serve: Serve, visit: Visit
) -> None:
    station = put_in(serve(own=True))
    station.end()
    fallen = {f"cf{n}": {"reason": "it fell", "at": None} for n in range(1, 5)}
    known = {"lost": fallen, "mended": [], "retired": []}
    kept = station.folder / "station" / "drones.json"
    kept.write_text(json.dumps({"kind": [True, False], "drones": known}))
    station.start()
    page = visit(station)
    button = page.get_by_role("button", name="Start 3 missions")
    expect(button).to_have_attribute("aria-disabled", "true")
    said = re.compile("^Every drone is lost: look after one")
    expect(button).to_have_accessible_description(said)
    open_drones(page)
    card = card_of(page, "cf2")
    card.get_by_role("button", name="Bring back").click()
    expect(button).not_to_have_attribute("aria-disabled", "true")
    expect(card).to_contain_text("Unknown")
    words = {id: (row["word"], row["x"], row["label"]) for id, row in seen(page).items()}
    lost = ("Lost", None, "")  # where they fell is not known: none is on the map
    assert words == {"cf1": lost, "cf2": ("Unknown", None, ""), "cf3": lost, "cf4": lost}
