"""The replay of any instant is what the live page showed then, of each example, over all its lives."""

from __future__ import annotations

import json
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from math import dist
from typing import Any

import pytest

from pluto_fleet.station.history.folder import recording_of
from pluto_fleet.station.history.frames import Shown
from pluto_fleet.station.history.recording import MOVES_EVERY, MOVING
from tests.kit.apps import NAMES
from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown

SPEED = 20
FASTEST = 4.0
"""Metres per second: what no drone of the examples flies."""
ENDS = ("over", "stopped", "interrupted")


@dataclass(slots=True)
class Page:
    """What one page was shown of one flight, from each instant on."""

    station: Flown
    views: dict[float, Shown] = field(default_factory=dict)
    log: list[Any] = field(default_factory=list)
    results: list[Any] = field(default_factory=list)
    flight: str = ""
    seen: int = 0
    shown: Shown = field(default_factory=Shown)

    def look(self) -> str:
        """Take what has changed, as a page does; return what goes on."""
        asked = {"seen": self.seen, "log": len(self.log), "results": len(self.results)}
        query = {name: str(number) for name, number in asked.items()}
        given = self.station.get("/api/live", flight=self.flight, **query)
        self.flight, self.seen = given["flight"], given["version"]
        self.log += given["log"]
        self.results += given["results"]
        for row in given["amended"]:
            self.results[row["number"] - 1] = row
        t = given["state"]["time"]
        self.shown.take_frame({**given, "t": t})
        self.views[t] = deepcopy(self.shown)
        return str(given["state"]["phase"])


def replayed(station: Flown, flight: str) -> list[dict[str, Any]]:
    """Fetch a whole replay, part by part, as a page does that plays it."""
    frames: list[dict[str, Any]] = []
    start: float | None = 0.0
    while start is not None:
        part = station.get("/api/flights/replay", flight=flight, start=str(start))
        assert (part["recorded"], part["said"]) == (True, "")
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


def differences(view: Shown, shown: Shown) -> list[str]:
    """Return what is not as it was: what only moves may be a quarter of a second old."""
    found = []
    if {**shown.state, "time": 0} != {**view.state, "time": 0}:
        found.append(f"{view.t}: {view.state} is replayed as {shown.state}")
    if shown.rows["missions"] != view.rows["missions"]:
        found.append(f"{view.t}: {view.rows['missions']} is replayed as {shown.rows['missions']}")
    assert shown.rows["drones"].keys() == view.rows["drones"].keys()
    for id, row in view.rows["drones"].items():
        mine = shown.rows["drones"][id]
        stays = [{k: v for k, v in one.items() if k not in MOVING} for one in (row, mine)]
        if stays[0] != stays[1] or not is_near(row, mine):
            found.append(f"{view.t}: {row} is replayed as {mine}")
    return found


def is_near(row: Mapping[str, Any], mine: Mapping[str, Any]) -> bool:
    """Whether a drone can have come from one place to the other within a quarter of a second."""
    if row["x"] is None or mine["x"] is None:
        return row["x"] is mine["x"]
    places = [[one[axis] for axis in "xyz"] for one in (row, mine)]
    return dist(*places) <= FASTEST * SPEED * MOVES_EVERY


FEW = ("aerial_mapping", "alfalfa", "drugs_distribution_retry")


@pytest.mark.parametrize(
    "name", [one if one in FEW else pytest.param(one, marks=pytest.mark.long) for one in NAMES]
)
def test_the_replay_of_every_instant_is_what_was_shown(serve: Serve, name: str) -> None:
    """State, missions and drones; the console and the results, too, line by line."""
    station = serve(name, speed=SPEED)
    station.tell("start")
    page = Page(station)
    station.until(lambda: page.look() in ENDS or len(page.views) > 60, "enough was seen")
    if station.phase == "flying":
        station.tell("stop", how="land")
    station.until(lambda: page.look() in ENDS, "the flight has ended")
    station.world.run(station.life.recorded())
    frames = replayed(station, page.flight)
    views = [(view, shown_at(frames, t)) for t, view in page.views.items()]
    assert [one for view, shown in views for one in differences(view, shown)] == []
    assert len(views) >= 20
    exactly = [view for view, shown in views if shown.rows["drones"] == view.rows["drones"]]
    assert len(exactly) >= len(views) / 5
    first = station.get("/api/flights/replay", flight=page.flight)
    assert (first["log"], first["results"]) == (page.log, page.results)
    for t in sorted(page.views)[:: len(views) // 5]:  # as a page does that scrubs
        scrubbed = station.get("/api/flights/replay", flight=page.flight, start=str(t))["frames"][0]
        whole = shown_at(frames, t)
        rows = [list(whole.rows[kind].values()) for kind in ("missions", "drones")]
        assert [scrubbed["t"], scrubbed["missions"], scrubbed["drones"]] == [whole.t, *rows]


def test_a_flight_is_replayed_over_all_its_lives(serve: Serve) -> None:
    """Between a death and the next life nothing is known of where drones are, and none is shown."""
    station = serve(speed=SPEED).flying()
    station.until(lambda: station.now()["state"]["time"] > 30, "it has flown for a while")
    station.kill()
    station.world.run(station.life.recorded())
    station.start()
    [flight] = station.get("/api/flights")
    assert (flight["end"], flight["recorded"]) == ("interrupted", True)
    before = replayed(station, flight["id"])
    station.tell("resume")
    station.completes_all_once()
    station.world.run(station.life.recorded())
    after = replayed(station, flight["id"])
    earlier = len(before) - 1
    assert after[:earlier] == before[:earlier]
    connecting = next(frame for frame in after[earlier:] if frame["state"]["busy"])
    assert connecting["t"] >= before[-1]["t"]
    assert {row["status"] for row in connecting["drones"]} <= {"UNKNOWN", "LANDED", "ALOFT"}
    [flight] = station.get("/api/flights")
    assert (flight["end"], flight["completed"]) == ("over", 3)
    assert station.ask("GET", "/api/flights/mcap", flight=flight["id"]).body.startswith(b"\x89MCAP")


def test_a_recording_that_cannot_be_written_is_said_and_the_flight_goes_on(
    serve: Serve, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its replay is what its journal tells then."""
    station = serve()
    journal = station.folder / "flight.journal"
    monkeypatch.setattr("pluto_fleet.journal.place.new_in", lambda *_: journal)
    recording_of(journal).mkdir()
    station.tell("start")
    station.completes_all_once()
    station.world.run(station.life.recorded())
    assert "this flight is not recorded any more" in json.dumps(station.now()["log"])
    part = station.get("/api/flights/replay", flight="flight")
    assert part["recorded"] is False
    assert "cannot be read" in part["said"]
    assert part["frames"][-1]["state"]["phase"] == "over"
