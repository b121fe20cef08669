"""A recording gives back what was shown at any instant, and no damage makes it show anything else."""

from __future__ import annotations

import gzip
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.station.history.frames import Shown
from pluto_fleet.station.history.recorded import Recorded
from pluto_fleet.station.history.recording import MOVES_EVERY, Recording

Scene = dict[str, Any]


FLYING = {"phase": "flying"}
CF1: Scene = {"id": "cf1", "status": "FREE", "battery": 1.0}
CF2: Scene = {"id": "cf2", "status": "BUSY", "battery": 0.5, "x": 0.1}
NORTH: Scene = {"name": "North", "status": "RUNNING", "at": ["watch"]}
SCENES: Sequence[Scene] = (
    {"state": FLYING, "missions": [], "drones": [{**CF1, "x": 0.5}]},
    {"state": FLYING, "missions": [NORTH], "drones": [CF1, CF2]},
    {"state": FLYING, "missions": [NORTH], "drones": [CF1, {**CF2, "x": 0.2}]},
    {"state": FLYING, "missions": [{**NORTH, "status": "FAILED"}], "drones": [CF2]},
    {"state": {"phase": "over"}, "missions": [], "drones": [{**CF1, "ready_in": 0.1}, CF2]},
)
"""Rows come, go, and gain and lose fields."""


def file_of(folder: Path) -> Path:
    """Return a file that is not there."""
    path = folder / "a.recording"
    path.unlink(missing_ok=True)
    return path


def write(recording: Recording, scenes: Sequence[Scene], begin: int = 0) -> None:
    """Show these scenes, a minute each, so that there are several keyframes."""
    for number, one in enumerate(scenes, start=begin):
        recording.write(number * 20.0, one["state"], one["missions"], one["drones"])


def scene_at(recorded: Recorded, t: float) -> Scene:
    """Return what a replay shows."""
    now = Shown()
    now.take_frame(next(recorded.frames(t)))
    rows = {kind: now.rows[kind] for kind in ("missions", "drones")}
    return {"state": {k: v for k, v in now.state.items() if k != "time"}, **rows}


def named(scene: Scene) -> Scene:
    """Return a scene with its rows by their names."""
    missions = {row["name"]: row for row in scene["missions"]}
    return {**scene, "missions": missions, "drones": {row["id"]: row for row in scene["drones"]}}


def check(recorded: Recorded, scenes: Sequence[Scene]) -> None:
    """Hold each instant of a replay to what was shown then, also those in between."""
    for number, one in enumerate(scenes):
        for later in (0.0, 19.0):
            assert scene_at(recorded, number * 20.0 + later) == named(one)


def test_what_was_cut_off_is_the_end_and_it_can_be_gone_on_with(tmp_path: Path) -> None:
    """As after a kill, at any byte: what is read is what was shown, up to some instant."""
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=1)
    for number, one in enumerate(SCENES):
        write(recording, [one], number)
        recording.flush()
    recording.finish()
    whole, lengths = path.read_bytes(), set[int]()
    for kept in range(0, len(whole) + 1, 2):
        path.write_bytes(whole[:kept])
        recorded = Recorded(path)
        left = 0 if recorded.begins is None else round(recorded.seconds / 20.0) + 1
        lengths.add(left)
        check(recorded, SCENES[:left])
        again = Recording(path, begun_at=1)
        write(again, SCENES[:2], left)
        again.finish()
        check(Recorded(path), [*SCENES[:left], *SCENES[:2]])
    assert lengths == {*range(len(SCENES) + 1)}


def test_a_bit_that_was_flipped_is_noticed(tmp_path: Path) -> None:
    """What cannot be read is left out, and nothing else is ever shown."""
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=1)
    write(recording, SCENES)
    recording.finish()
    whole = path.read_bytes()
    for place in range(len(whole)):
        damaged = bytearray(whole)
        damaged[place] ^= 1 << place % 8
        path.write_bytes(damaged)
        recorded = Recorded(path)
        for frame in recorded.frames(0.0):
            assert scene_at(recorded, frame["t"]) in map(named, SCENES)


def test_a_reader_that_was_there_before_sees_what_is_added(tmp_path: Path) -> None:
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=7)
    recording.write(0.0, {"phase": "flying"}, [], [{"id": "cf1", "battery": 1.0}])
    recording.flush()
    recorded = Recorded(path)
    for t in range(1, 100):
        recording.write(float(t), {"phase": "flying"}, [], [{"id": "cf1", "battery": 1 - t / 100}])
        recording.tell({"text": str(t)}, after=t)
        recording.flush()
        if t % 7 == 0:
            recorded.refresh()
            assert recorded.seconds == t
    recording.finish()
    recorded.refresh()
    assert recorded.begun_at == 7
    assert [line["text"] for line, _ in recorded.said] == [str(t) for t in range(1, 100)]
    assert recorded.batteries == Recorded(path).batteries
    assert recorded.batteries["cf1"][0] == [0.0, 1.0]


def test_any_program_reads_it_with_gzip(tmp_path: Path) -> None:
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=7)
    recording.write(0.0, {"phase": "flying"}, [], [{"id": "cf1", "x": 1.0}])
    recording.write(1.0, {"phase": "flying"}, [], [{"id": "cf1", "x": 2.0}])
    recording.finish()
    head, key, moved = map(json.loads, gzip.decompress(path.read_bytes()).splitlines())
    assert head == {"recording": 1, "begun_at": 7}
    assert key["key"] is True
    assert moved == {"t": 1.0, "drones": {"cf1": {"x": 2.0}}}


def test_what_only_moves_is_kept_four_times_a_second(tmp_path: Path) -> None:
    """What else changes is kept at once, with where everything is then."""
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=0)
    for tick in range(100):
        status = "BUSY" if tick < 50 else "RETURNING"
        row = {"id": "cf1", "x": float(tick), "status": status}
        recording.write(tick * 0.1, {"phase": "flying"}, [], [row])
    recording.finish()
    recorded = Recorded(path)
    frames = list(recorded.frames(0.0))
    assert len(frames) <= 10 / MOVES_EVERY + 1
    assert any(frame["t"] == 5.0 for frame in frames)
    assert scene_at(recorded, 5.05)["drones"] == {
        "cf1": {"id": "cf1", "x": 50.0, "status": "RETURNING"}
    }


def test_a_recording_that_becomes_too_large_ends_and_can_be_read(tmp_path: Path) -> None:
    path = file_of(tmp_path)
    recording = Recording(path, begun_at=0, largest=4_000)
    with pytest.raises(OSError, match="which is the most"):
        for t in range(10_000):
            recording.write(float(t), {"phase": "flying", "said": str(t * 7919)}, [], [])
            recording.flush()
    recording.finish()
    recorded = Recorded(path)
    assert path.stat().st_size <= 4_000
    assert recorded.seconds > 0
