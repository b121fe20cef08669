"""Journals and recordings of a stranger are read as far as they can be, or refused in a sentence."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.station.history.folder import recording_of
from tests.forged.__main__ import one
from tests.forged.files import DEEP, write_events
from tests.forged.floods import MOST_MEMORY, flooded
from tests.forged.readers import FLIGHT, faults_of
from tests.library.station.history.test_past import ROWS, frames_of, kept, past_of

KEY: dict[str, Any] = {"t": 0.0, "key": True, "state": {"phase": "flying"}, "drones": [{"id": "d"}]}
MOVED: dict[str, Any] = {"t": 2.0, "drones": {"d": {"x": 1.0}}}


@pytest.mark.parametrize("number", range(18))
def test_what_was_written_to_do_harm_does_none(number: int) -> None:
    """See `python -m tests.forged`."""
    assert one(number) == []


@pytest.mark.parametrize(
    "line",
    [
        '{"log": 1}',
        '{"log": {"time": "x"}, "after": 0}',
        '{"t": 1, "drones": [1]}',
        '{"t": 1, "key": true, "drones": [{"x": 1}]}',
        '{"t": 1, "drones": {"d": {"x": "far"}}}',
        '{"t": 1, "drones": {"d": {"-": 3}}}',
        '{"t": 1, "state": {"phase": 3}}',
        '{"t": 1, "missions": {"m": {"wait": "x"}}}',
        '{"t": 1e999}',
        '{"t": -1}',
        '{"t": null}',
        '{"result": {}}',
        "[]",
        DEEP,
    ],
)
def test_a_line_of_a_recording_that_says_nothing_is_left_out_and_counted(
    tmp_path: Path, line: str
) -> None:
    lines = [json.dumps({"recording": 1, "begun_at": 7}), json.dumps(KEY), line, json.dumps(MOVED)]
    text = "\n".join([*lines, ""]).encode()
    recording_of(kept(tmp_path, FLIGHT)).write_bytes(gzip.compress(text))
    assert list(faults_of(tmp_path)) == []
    past = past_of(tmp_path)
    assert "1 line of the recording say" in past.replay(FLIGHT, 0.0)["said"]
    [first, moved] = frames_of(past, FLIGHT)
    assert (first["drones"], moved["drones"]) == ([{"id": "d"}], [{"id": "d", "x": 1.0}])


def test_a_recording_that_says_nothing_at_all_is_told_as_such(tmp_path: Path) -> None:
    """What its journal tells is shown all the same."""
    recording_of(kept(tmp_path, FLIGHT)).write_bytes(gzip.compress(b'{"log": 1}\n' * 20_000))
    past = past_of(tmp_path)
    assert "10000 of its lines say nothing" in past.replay(FLIGHT, 0.0)["said"]
    assert frames_of(past, FLIGHT)


def test_a_flight_of_years_is_replayed_in_time(tmp_path: Path) -> None:
    """An instant may be as late as one likes: the frames in between are further apart then."""
    (_, header), *_ = map(json.loads, ROWS.read_text("utf-8").splitlines())
    began = {"t": 0.0, "event": "brain.began", "epoch": 1}
    flew = {
        "event": "drone.flew",
        "drone": "scout1",
        "what": "leg",
        "from": [0.0, 0.0, 1.0],
        "to": [5.0, 5.0, 1.0],
        "battery": [1.0, 0.5],
        "ended": "done",
    }
    end = {"t": 9e8, **flew, "seconds": 9e8}
    write_events(kept(tmp_path, FLIGHT), [json.dumps([header]), json.dumps([began, end])])
    assert list(faults_of(tmp_path, only=("replay", "report", "flights", "mcap"))) == []


@pytest.mark.long
def test_a_flooded_station_serves_its_page_and_stays_small() -> None:
    """See `python -m tests.forged.floods`: by real processes, with a Stop at the end."""
    figures = flooded(10.0)
    assert figures.faults == []
    assert figures.answers > 20 and figures.asked > 5
    assert figures.memory < MOST_MEMORY
