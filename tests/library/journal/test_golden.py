"""What any version has written down, every later one goes on from."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from pathlib import Path

import pytest

from pluto_fleet.journal.header import EVENTS, LANGUAGE
from plutoc import __version__
from tests.kit.apps import compiled_file
from tests.library.journal.keeping import (
    APP,
    GOLDEN,
    JOURNAL,
    RECORDS,
    SOURCE,
    records_of,
    said,
    written,
)

KEPT = sorted(path for path in GOLDEN.iterdir() if path != SOURCE)
each_version = pytest.mark.parametrize("kept", KEPT, ids=lambda path: str(path.name))


def test_this_version_has_its_journal() -> None:
    """`python -m tests.library.journal.keeping` makes it."""
    assert f"{LANGUAGE}-{__version__}-{EVENTS}" in [kept.name for kept in KEPT]


@each_version
def test_it_comes_to_the_same_as_when_it_was_written(
    kept: Path, tmp_path: Path, update: bool
) -> None:
    shutil.copyfile(kept / JOURNAL, tmp_path / JOURNAL)
    records = records_of(tmp_path / JOURNAL)
    if update:
        (kept / RECORDS).write_text(written(records))
    assert json.loads((kept / RECORDS).read_text()) == records


@each_version
def test_an_app_compiled_today_goes_on_to_the_end_and_flies_nothing_twice(
    kept: Path, tmp_path: Path
) -> None:
    journal = tmp_path / JOURNAL
    shutil.copyfile(kept / JOURNAL, journal)
    package = compiled_file(kept / "app.pluto", tmp_path / APP)
    code, report = said(package, "resume", journal, "--sim", "--speed", "100")
    events = [json.loads(line) for line in said(package, "journal", journal, "--json")[1]]
    done = Counter(
        (event["mission"], event["trip"], event["round"])
        for event in events
        if event["event"] == "trip.completed"
    )
    north = [("North", trip, 0) for trip in ("A", "B", "second look")]
    ward = [("Ward", trip, 0) for trip in ("pick", "release", "look")]
    south = [("South", trip, turn) for trip in ("A", "B") for turn in (0, 1)]
    assert code == 0, "\n".join(report)
    assert any(event["event"] == "drone.flew" for event in events)
    assert done == Counter([*north, *ward, *south])
    assert "3 of 3 missions completed" in report[-1]
