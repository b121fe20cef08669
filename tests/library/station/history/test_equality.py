"""The replay of any instant is what the live page showed then, of each example."""

from __future__ import annotations

from collections.abc import Mapping
from math import dist
from typing import Any

import pytest

from pluto_fleet.station.history.frames import Shown
from pluto_fleet.station.history.recording import MOVES_EVERY, MOVING
from tests.kit.apps import NAMES
from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import tell
from tests.library.station.history.looking import Page, View

SPEED = 30
SLOWER = {"aerial_mapping": 10, "object_finder": 10}
"""Of a flight that is over too soon."""

INSTANTS = 50

FASTEST = 4.0
"""Metres per second: what no drone of the examples flies."""


def without(row: Mapping[str, Any], names: frozenset[str]) -> dict[str, Any]:
    return {name: value for name, value in row.items() if name not in names}


def replayed(station: Station, flight: str) -> list[dict[str, Any]]:
    """Fetch a whole replay, part by part, as a page does that plays it."""
    frames: list[dict[str, Any]] = []
    start: float | None = 0.0
    while start is not None:
        part = station.get(f"/api/flights/replay?flight={flight}&start={start}")
        assert part["recorded"]
        assert part["said"] == ""
        frames += part["frames"]
        start = part["next"]
    return frames


def shown_at(frames: list[dict[str, Any]], t: float) -> Shown:
    """Return what a page shows of these frames at an instant."""
    shown = Shown()
    for frame in frames:
        if frame["t"] > t:
            break
        shown.take_frame(frame)
    return shown


def differences(view: View, shown: Shown) -> list[str]:
    """Return what is not as it was: what only moves may be a quarter of a second old."""
    found = []
    if {**shown.state, "time": 0} != {**view.state, "time": 0}:
        found.append(f"{view.t}: {view.state} is replayed as {shown.state}")
    if shown.rows["missions"] != view.missions:
        found.append(f"{view.t}: {view.missions} is replayed as {shown.rows['missions']}")
    assert shown.rows["drones"].keys() == view.drones.keys()
    for id, row in view.drones.items():
        mine = shown.rows["drones"][id]
        if without(mine, MOVING) != without(row, MOVING) or not is_near(row, mine):
            found.append(f"{view.t}: {row} is replayed as {mine}")
    return found


def is_near(row: Mapping[str, Any], mine: Mapping[str, Any]) -> bool:
    """Whether a drone can have come from one place to the other within a quarter of a second."""
    if row["x"] is None or mine["x"] is None:
        return row["x"] is mine["x"]
    places = [[one[axis] for axis in "xyz"] for one in (row, mine)]
    return dist(*places) <= FASTEST * SPEED * MOVES_EVERY


@pytest.mark.parametrize("name", NAMES)
def test_the_replay_of_fifty_instants_is_what_was_shown(serve: Serve, name: str) -> None:
    """State, missions and drones; the console and the results, too, line by line."""
    station = serve(name, "--speed", str(SLOWER.get(name, SPEED)))
    tell(station, "start")
    page = Page(station)
    flight = page.look(INSTANTS)
    views = {view.t: view for view in page.views}
    frames = replayed(station, flight)
    # what the thread has not written yet is not there; the last instants may be among that
    held = [view for t, view in views.items() if t <= frames[-1]["t"]]
    wrong = [one for view in held for one in differences(view, shown_at(frames, view.t))]
    assert wrong == []
    if station.phase == "flying":
        tell(station, "stop", how="land")
    page.look()
    until(
        lambda: replayed(station, flight)[-1]["state"]["phase"] == page.views[-1].state["phase"],
        "the end is recorded",
    )
    frames = replayed(station, flight)
    views.update((view.t, view) for view in page.views)
    wrong = [one for view in views.values() for one in differences(view, shown_at(frames, view.t))]
    assert wrong == []
    assert len(views) >= INSTANTS
    exactly = [v for v in views.values() if shown_at(frames, v.t).rows["drones"] == v.drones]
    assert len(exactly) >= INSTANTS / 5
    first = station.get(f"/api/flights/replay?flight={flight}")
    assert (first["log"], first["results"]) == (page.log, page.results)
    for when in sorted(views)[:: len(views) // 5]:  # as a page does that scrubs
        scrubbed = station.get(f"/api/flights/replay?flight={flight}&start={when}")["frames"][0]
        whole = shown_at(frames, when)
        assert (scrubbed["t"], scrubbed["missions"], scrubbed["drones"]) == (
            whole.t,
            list(whole.rows["missions"].values()),
            list(whole.rows["drones"].values()),
        )
