"""After every way to end and to start again, the page shows each drone as it is in the world.

Place, status and reason, read off the page as a person reads them; what is not known is shown as
unknown.
"""

from __future__ import annotations

import json
import os
import re
import signal
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from pluto_fleet.gateway.starting import still_runs
from pluto_fleet.journal.place import gateway_folder
from tests.kit.browser import BREAKS, Watch
from tests.kit.station import Station, until
from tests.library.station.browser.conftest import Serve, Visit
from tests.library.station.browser.exercise import put_in
from tests.library.station.browser.steps import open_page, start
from tests.library.station.browser.world import disagreements, truth

AS_SEEN = Path(__file__).with_name("as_seen.js").read_text(encoding="utf-8")

STATUS = {"Lost": "LOST", "On the ground": "LANDED", "Unknown": "UNKNOWN", "In the air": "ALOFT"}

PIXEL = 0.15
"""Metres."""


def seen(page: Page) -> list[dict[str, Any]]:
    """Return what list and map say of each drone."""
    rows: list[dict[str, Any]] = page.evaluate(AS_SEEN)
    for row in rows:
        row["status"] = STATUS.get(row["word"], row["word"])
        row["reason"] = row["why"]
        row["why"] = row["why"].partition(" · ")[0]
    return rows


def agree(page: Page, station: Station, *words: str) -> list[dict[str, Any]]:
    """See that page and world come to agree on each drone, and to no other words than these."""
    scratch = station.folder / "scratch"

    def holds() -> bool:
        rows = seen(page)
        return (
            len(rows) == len(station.get("/api/app")["drones"])
            and {row["word"] for row in rows} <= {*words}
            and all(row["word"] in row["label"] for row in rows if row["label"])
            and not disagreements(rows, truth(station, scratch), PIXEL)
        )

    until(holds, lambda: f"page and world agree: {seen(page)} {truth(station, scratch)}")
    return seen(page)


def is_away(station: Station) -> bool:
    """Whether a drone is in the air, and well away from home."""
    homes = {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}
    heard = [row for row in station.now()["drones"] if row["seen_at"] is None]
    rows = [row for row in heard if row["x"] is not None and row["z"] > 0.3]
    return any(abs(row["x"] - homes[row["id"]][0]) > 1 for row in rows)


def flies(page: Page, station: Station) -> None:
    """Resume, and see a drone away from home."""
    page.get_by_role("button", name="Resume").click()
    until(lambda: station.phase == "flying" and is_away(station), "a drone is away")


@pytest.mark.long  # many flights, as in tests/library/station/flights/test_at_rest.py
def test_page_and_world_agree_on_each_drone_after_every_end_and_every_new_start(
    serve: Serve, visit: Visit, watch: Watch
) -> None:
    watch.expected += BREAKS
    station = put_in(serve("drugs_distribution", "--speed", "8", own=True))
    page = visit(station)
    start(page)
    open_drones(page)
    until(lambda: is_away(station), "a drone is away")
    page.get_by_role("button", name="Stop: land now").click()
    until(lambda: station.phase == "stopped", "all have landed")
    for row in agree(page, station, "On the ground"):
        assert re.search(r"at [\d.]+; [\d.]+, seen \d+ s ago", row["reason"])
    flies(page, station)
    gateway = gateway_of(station)
    station.kill()
    os.kill(gateway, signal.SIGKILL)
    station.start()
    rows = agree(page, station, "On the ground", "Unknown")
    for row in rows:
        unknown = row["why"].startswith("it was in the air when it was last heard of")
        assert unknown is (row["word"] == "Unknown")

    flies(page, station)
    until(lambda: bool(flown_by(station)), "a drone flies for a mission")
    who = flown_by(station)[0]
    assert station.post("/api/cut-motors", {"id": "falls", "drone": who})[0] == 200
    until(lambda: lost(page) == [who], "it is seen that it is lost")
    page.get_by_role("button", name="Stop: land now").click()
    until(lambda: station.phase == "stopped", "all have landed")
    agree(page, station, "On the ground", "Lost")
    station.kill()
    station.start()
    rows = agree(page, station, "On the ground", "Lost")
    assert [row["why"] for row in rows if row["word"] == "Lost"] == [f"{who}'s motors were cut"]
    card = card_of(page, who)
    expect(card).to_contain_text(f"{who}'s motors were cut")
    card.get_by_role("button", name="Bring back").click()
    for shown in (card, page.get_by_role("listitem").filter(has_text=who)):
        expect(shown).to_contain_text("Unknown")
        expect(shown).to_contain_text(
            "it was brought back: it is asked how it is as soon as missions fly"
        )


def open_drones(page: Page) -> None:
    """Open the Monitor's list of drones."""
    open_page(page, "Monitor")
    page.get_by_role("tab", name="Drones").click()


def card_of(page: Page, drone: str) -> Locator:
    """Open a drone's card."""
    page.get_by_role("listitem").get_by_role("button", name=drone).click()
    return page.get_by_role("region", name=f"Drone {drone}")


def flown_by(station: Station) -> list[str]:
    """Return who is in the air for a mission."""
    rows = station.now()["drones"]
    return [row["id"] for row in rows if row["status"] == "BUSY" and row["z"] > 0.3]


def lost(page: Page) -> list[str]:
    """Return the drones that the page calls lost."""
    return [row["id"] for row in seen(page) if row["word"] == "Lost"]


def gateway_of(station: Station) -> int:
    """Return the process of the gateway."""
    process = still_runs(gateway_folder(station.journals()[-1]))
    assert process is not None
    return process


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
    words = {row["id"]: (row["word"], row["x"], row["label"]) for row in seen(page)}
    lost = ("Lost", None, "")  # where they fell is not known: none is on the map
    assert words == {"cf1": lost, "cf2": ("Unknown", None, ""), "cf3": lost, "cf4": lost}
