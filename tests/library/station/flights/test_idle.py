"""What is shown of a drone that no app flies, by what its gateway has heard of it last and what its journal knows."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.gateway.sightings import SEEN
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.standing import Standing, inherited
from pluto_fleet.station.between_flights import BACK, COMES_DOWN, HOVERED, NEVER, IdleDrones
from pluto_fleet.station.wire import DroneRow
from tests.library.station.plan.drawing import FLEET

ENTRY = FLEET.drones[0]
AGO = 60.0


def shown(folder: Path, seen: list[Any] | None, **known: Any) -> DroneRow:
    """Return the row of a drone; what was seen is whether it has landed, how long ago, and what failed."""
    journal = folder / "a.journal"
    records = Standing(inherited(known))
    if seen is not None:
        landed, ago, failure, why = (*seen, "", "")[:4]
        told = {
            "at": [5.0, 6.0, 0.0],
            "battery": 0.4,
            "landed": landed,
            "when": time.time() - ago,
            "why": why,
            "crashed": failure == "crash",
        }
        gateway_folder(journal).mkdir(parents=True)
        (gateway_folder(journal) / SEEN).write_text(json.dumps({ENTRY.id: told}))
    [row] = IdleDrones([ENTRY], journal).rows(records)
    return row


FELL = {ENTRY.id: {"reason": "it fell", "at": [1.0, 2.0, 0.0]}}


@pytest.mark.parametrize(
    ("seen", "known", "status", "why", "x"),
    [
        (None, {}, "UNKNOWN", NEVER, None),
        ([True, AGO], {}, "LANDED", "", 5.0),
        ([False, 0.0], {}, "ALOFT", COMES_DOWN, 5.0),
        ([False, AGO], {}, "UNKNOWN", HOVERED, 5.0),
        ([True, 0.0, "crash", "it hit a wall"], {}, "LOST", "it hit a wall", 5.0),
        ([False, 0.0, "crash", "it hit a wall"], {}, "UNKNOWN", "it hit a wall", 5.0),
        ([True, 0.0, "link", "it is silent"], {}, "UNKNOWN", "it is silent", 5.0),
        ([True, 0.0], {"lost": FELL}, "LOST", "it fell", 5.0),
        (None, {"lost": FELL}, "LOST", "it fell", 1.0),
        ([True, 0.0], {"lost": FELL, "mended": [ENTRY.id]}, "UNKNOWN", BACK, None),
    ],
)
def test_a_drone_is_shown_as_it_is_known(
    tmp_path: Path,
    seen: list[Any] | None,
    known: dict[str, Any],
    status: str,
    why: str,
    x: float | None,
) -> None:
    row = shown(tmp_path, seen, **known)
    assert (row["status"], row["why"], row["x"], row["retired"]) == (status, why, x, False)
    assert shown(tmp_path / "other", seen, retired=[ENTRY.id], **known)["retired"] is True
