"""What has not been completed is flown again alone; what was completed, only by choice."""

from __future__ import annotations

import os
import subprocess
from typing import Any

from pluto_fleet.journal.lock import holder
from tests.kit.station import Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import comes_to, flies, flying, refused, tell


def ends(station: Station) -> dict[str, Any]:
    """Return how the missions of the plan have ended."""
    return {one["name"]: one["ended"] for one in station.get("/api/plan")["missions"]}


def key_of(station: Station, name: str) -> str:
    return next(str(m["key"]) for m in station.get("/api/plan")["missions"] if m["name"] == name)


def test_what_was_not_completed_flies_again_alone_also_after_a_crash_of_the_station(
    serve: Serve,
) -> None:
    """Nothing is flown twice but what a person chose, and then from its beginning."""
    station = flying(serve("drugs_distribution", "--speed", "60"))
    one = key_of(station, "Mission 1")
    assert "belongs to the flight that is under way" in refused(station, "start", missions=[one])[1]
    tell(station, "cancel", mission="Mission 1")
    comes_to(station, "over")
    others = {"Mission 2": "COMPLETED", "Mission 3": "COMPLETED"}
    assert ends(station) == {"Mission 1": "CANCELLED", **others}
    station.kill()
    station.start()
    assert ends(station) == {"Mission 1": "CANCELLED", **others}
    assert tell(station, "start") == "1 mission started"
    assert tell(station, "start") == "every mission of the plan flies already"
    comes_to(station, "over")
    assert station.statuses() == {"Mission 1": "COMPLETED"}
    assert tell(station, "start", missions=[key_of(station, "Mission 2")]) == "1 mission started"
    comes_to(station, "over")
    assert station.statuses() == {"Mission 2": "COMPLETED"}
    assert tell(station, "start") == "3 missions started"


def test_no_start_flies_beside_or_again_what_a_command_goes_on_with(
    serve: Serve,
) -> None:
    station = flying(serve("drugs_distribution", "--speed", "20"))
    station.kill()
    (journal,) = station.journals()
    words = [os.fspath(station.app.program), "resume", os.fspath(journal)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT) as command:
        until(lambda: holder(journal) == command.pid, "the command goes on with it")
        station.start()
        told = refused(station, "start")[1]
        assert f"the last flight was gone on with elsewhere (process {command.pid})" in told
    revision = station.get("/api/plan")["revision"]
    assert "the plan has changed meanwhile" in refused(station, "start", revision=revision)[1]
    assert station.phase == "over"
    assert ends(station) == dict.fromkeys(("Mission 1", "Mission 2", "Mission 3"), "COMPLETED")
    assert len(station.journals()) == 1


def test_of_what_was_put_away_the_next_start_leaves_out_what_was_completed(serve: Serve) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    tell(station, "start")
    until(lambda: "COMPLETED" in station.statuses().values(), "one is completed")
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    done = [name for name, status in station.statuses().items() if status == "COMPLETED"]
    tell(station, "discard")
    assert [name for name, end in ends(station).items() if end == "COMPLETED"] == done
    assert set(ends(station).values()) == {"COMPLETED", "BROKEN_OFF"}
    said = tell(station, "start")
    assert said.startswith(f"{3 - len(done)} mission")
    flies(station)
    assert not {*done} & {*station.statuses()}
    wrong = refused(station, "start", missions=["Mission 1"])[1]
    assert wrong.startswith('no mission of the plan has the key "Mission 1"')
    assert refused(station, "start", missions=[1])[0] == 400
