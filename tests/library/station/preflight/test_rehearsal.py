"""The median run is recorded, and replayed as a flight is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.history.past import PastFlights
from pluto_fleet.station.preflight.preflight import KEPT
from tests.library.files.an_app import APP
from tests.library.station.preflight.asking import FLEET, THREE, answer, photos, question


def replayed(folder: Path, id: str) -> tuple[float, list[dict[str, Any]], list[Any]]:
    """Return how long a replay is, all its frames, and its console."""
    config = StationConfig(folder=folder, fleet=FLEET, faults={})
    past = PastFlights(APP, config, lambda: None)
    frames: list[dict[str, Any]] = []
    first = part = past.replay(id, 0.0)
    while True:
        frames += part["frames"]  # type: ignore[arg-type]
        if part["next"] is None:
            return first["seconds"], frames, first["log"]
        part = past.replay(id, part["next"])


def test_a_rehearsal_ends_at_the_median_with_every_mission_done(tmp_path: Path) -> None:
    forecast = answer(question(*THREE), tmp_path / "station")
    assert forecast["rehearsal"] is not None
    assert forecast["rehearsal"].startswith("rehearsal-")
    seconds, frames, log = replayed(tmp_path, forecast["rehearsal"])
    assert forecast["median"] is not None
    ends = [line["time"] for line in log if line["text"] == "COMPLETED"]
    assert len(ends) == 3
    assert max(ends) == round(forecast["median"], 6)
    assert seconds >= forecast["median"]
    missions = {row["name"]: row for frame in frames for row in frame["missions"]}
    assert {row["status"] for row in missions.values()} == {"COMPLETED"}
    rows = [row for frame in frames for row in frame["drones"]]
    assert len({(row["x"], row["y"]) for row in rows}) > len(log) + 10  # also between two events
    assert min(row["battery"] for row in rows) < 1.0


def test_only_the_newest_are_kept_and_none_of_what_was_given_up(tmp_path: Path) -> None:
    made = [
        answer(question(photos("mission-one", 1), runs=1), tmp_path)["rehearsal"]
        for _ in range(KEPT + 2)
    ]
    there = {path.stem for path in (tmp_path / "rehearsals").iterdir()}
    assert there == set(made[-KEPT:])


def test_a_rehearsal_that_cannot_be_written_takes_nothing_from_the_forecast(tmp_path: Path) -> None:
    (tmp_path / "rehearsals").write_text("no folder")
    forecast = answer(question(photos("mission-one", 1)), tmp_path)
    assert forecast["rehearsal"] is None
    assert forecast["median"] is not None
    assert [one["key"] for one in forecast["assumed"]] == ["preflight.no-rehearsal"]
