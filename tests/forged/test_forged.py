"""Journals of a stranger are read as far as they can be, or refused in a sentence."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.forged.__main__ import _texts, one
from tests.forged.files import write_events
from tests.forged.floods import FEWEST, MOST_MEMORY, flooded
from tests.forged.readers import FLIGHT, faults_of
from tests.library.station.history.test_past import ROWS, frames_of, kept, past_of

SHOWN = {"t": 300.0, "event": "shown", "drones": {"d": {"id": "d", "status": "FREE"}}}


@pytest.mark.parametrize("number", range(18))
def test_what_was_written_to_do_harm_does_none(number: int) -> None:
    """See `python -m tests.forged`."""
    assert one(number) == []


@pytest.mark.parametrize(
    "facts",
    [
        {"drones": [1]},
        {"drones": {"d": 1}},
        {"drones": {"d": {"x": "far"}}},
        {"drones": {"d": {"-": 3}}},
        {"state": {"phase": 3}},
        {"missions": {"m": {"wait": "x"}}},
        {"missions": {"m": {"trips": {"0": {"name": "A"}}}}},
        {"missions": {"m": {"trips": []}}, "drones": {"d": {"trips": "x"}}},
        {"alerts": {"a": {"urgent": "very"}}},
    ],
)
def test_what_was_not_shown_is_told_and_what_stands_before_it_is_shown(
    tmp_path: Path, facts: dict[str, Any]
) -> None:
    rows = [json.loads(row) for row in _texts()]
    rows += [[SHOWN], [{"t": 301.0, "event": "shown", **facts}], [{**SHOWN, "t": 302.0}]]
    write_events(kept(tmp_path, FLIGHT), [json.dumps(row) for row in rows])
    assert list(faults_of(tmp_path)) == []
    past = past_of(tmp_path)
    assert "entry" in past.replay(FLIGHT, 0.0)["said"]
    assert any(row["id"] == "d" for frame in frames_of(past, FLIGHT) for row in frame["drones"])


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
    assert figures.answers > 20 and figures.asked > FEWEST
    assert figures.memory < MOST_MEMORY
