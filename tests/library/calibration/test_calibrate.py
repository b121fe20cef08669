"""`pluto-fleet calibrate`: what it prints and writes, and what it says of what it cannot read."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from pluto_fleet.__main__ import main
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.calibrating.flights import surveyed
from tests.kit.command import run
from tests.kit.session import check_session, sessions

MOVES = replace(
    CRAZYFLIE, pace=1.1, settles=0.6, take_off=0.8, landing=1.2, drain=1.25, spread=0.02
)
CRAWLS = replace(MOVES, pace=12.0, drain=0.2)
FLIGHTS = {
    "a-tour": {"motion": MOVES, "trips": 60},
    "another": {"motion": MOVES, "trips": 30, "seed": 5},
    "one-trip": {"motion": MOVES, "trips": 1, "drones": 1},
    "a-crawl": {"motion": CRAWLS, "trips": 20, "drones": 1},
}
"""What is flown in sessions."""
EVENTS = {"nothing": [], "a-measurement": [{"t": 1.0, "event": "drone.flew", "drone": "a"}]}
"""What stands in journals that nobody has flown."""


def calibrate(words: Sequence[str]) -> int:
    return main(["calibrate", *words])


def fly(words: Sequence[str]) -> int:
    """Make the journal of a flight: `fly a-tour J`."""
    what, path = words
    Path(path).write_bytes(made(what))
    return 0


@cache
def made(what: str) -> bytes:
    """Return a journal."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "J")
        if what in FLIGHTS:
            surveyed(path, said=CRAZYFLIE, **FLIGHTS[what])  # type: ignore[arg-type]
        else:
            with closing(Store.create(path, {"t": 0.0, "event": "journal.begun"})) as store:
                store.append([Entry(json.dumps([event])) for event in EVENTS[what]])
        return path.read_bytes()


def damage(words: Sequence[str]) -> int:
    """Let a disk lose a page in the middle of a file."""
    (path,) = map(Path, words)
    data = path.read_bytes()
    middle = len(data) // 2
    path.write_bytes(data[:middle] + bytes(range(256)) * 16 + data[middle + 4096 :])
    return 0


@pytest.fixture
def journal(tmp_path: Path) -> Path:
    fly(["a-tour", str(tmp_path / "J")])
    return tmp_path / "J"


def masked(text: str) -> str:
    """Leave out how many rows of a damaged journal can be read, which is SQLite's matter."""
    return re.sub(r"(from row|rows \d+ to) .* be read\.", "from a row on.", text)


@pytest.mark.parametrize("session", sessions(Path(__file__).parent / "sessions"))
def test_what_is_typed_prints_what_is_written(session: Path, update: bool, tmp_path: Path) -> None:
    programs = {"calibrate": calibrate, "fly": fly, "damage": damage}
    check_session(session, programs, update, tmp_path, masked)


def test_programs_get_the_same_in_si_units(journal: Path) -> None:
    data = json.loads(run(calibrate, journal, "--json").out)
    assert (data["commands"], data["journals"], data["untold"]) == (300, [str(journal)], {})
    pace = data["found"]["pace"]
    assert (pace["said"], pace["count"], pace["of"]) == (1.0, 120, "leg")
    assert pace["interval"][0] < pace["value"] < pace["interval"][1]
    assert data["found"]["drain"]["value"] == pytest.approx(1.25, abs=1e-3)


def test_a_file_that_is_written_stays_what_it_was_otherwise(journal: Path, tmp_path: Path) -> None:
    """Its line ends, its permissions, and a link to it."""
    file = tmp_path / "F.toml"
    file.write_bytes(b"# our hall\r\n[motion]\r\nlimit = 1.0\r\n")
    file.chmod(0o640)
    (link := tmp_path / "link.toml").symlink_to(file)
    assert run(calibrate, journal, "--write", link).code == 0
    text = file.read_bytes().decode()
    assert 'drain = "125 %"\r\n' in text
    assert text.count("\n") == text.count("\r\n")
    assert link.is_symlink() and file.stat().st_mode & 0o777 == 0o640
