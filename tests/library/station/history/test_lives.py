"""What is recorded of a flight that is killed, gone on with, or whose recording fails."""

from __future__ import annotations

import json
import time
from typing import Any

from pluto_fleet.station.history.folder import recording_of
from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import completes_all_once, flying, tell


def replay(station: Station, start: float = 0.0) -> dict[str, Any]:
    """Return a part of the replay of its first flight."""
    part: dict[str, Any] = station.get(
        f"/api/flights/replay?flight={station.journals()[0].stem}&start={start}"
    )
    return part


def test_a_flight_is_replayed_over_all_its_lives(serve: Serve) -> None:
    """Between a kill and the next life nothing is known of where drones are, and none is shown."""
    station = flying(serve("drugs_distribution", "--speed", "25"))
    until(lambda: replay(station)["recorded"], "something is recorded")
    until(lambda: replay(station)["seconds"] > 30, "it has flown for a while")
    station.kill()
    station.start()
    before = replay(station)
    assert before["recorded"]
    assert before["frames"][-1]["state"]["phase"] == "flying"
    [flight] = station.get("/api/flights")
    assert (flight["end"], flight["recorded"]) == ("interrupted", True)
    tell(station, "resume")
    completes_all_once(station)
    until(lambda: replay(station)["frames"][-1]["state"]["phase"] == "over", "all is recorded")
    after = replay(station)
    earlier = len(before["frames"]) - 1
    assert after["frames"][:earlier] == before["frames"][:earlier]
    [connecting, *_] = [
        frame
        for frame in after["frames"][earlier:]
        if frame["t"] >= before["seconds"] and frame["state"]["busy"]
    ]
    assert connecting["t"] == before["seconds"]
    assert {row["status"] for row in connecting["drones"]} <= {"UNKNOWN", "LANDED", "ALOFT"}
    [flight] = station.get("/api/flights")
    assert (flight["end"], flight["completed"]) == ("over", 3)


def test_a_recording_that_cannot_be_written_is_said_and_the_flight_goes_on(serve: Serve) -> None:
    """Its replay is what its journal tells then."""
    station = serve("drugs_distribution", "--speed", "30")
    for later in range(120):  # whenever it begins, a folder is where its recording would be
        begun = time.strftime("%Y-%m-%d-%H%M%S", time.localtime(time.time() + later))
        recording_of(station.folder / f"{begun}.journal").mkdir()
    tell(station, "start")
    completes_all_once(station)
    assert "this flight is not recorded any more" in json.dumps(station.now()["log"])
    part = replay(station)
    assert part["recorded"] is False
    assert "cannot be read" in part["said"]
    assert part["frames"][-1]["state"]["phase"] == "over"
