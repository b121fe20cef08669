"""`journal` prints what happened: for people, for programs, while it happens, and of what is left."""

from __future__ import annotations

import json
import os
import re
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from pluto_fleet.cli import main
from pluto_fleet.journal import place
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.report.sentences import journal_sentence
from pluto_fleet.shared.domain.status import DroneStatus
from tests.library.files.an_app import APP
from tests.paths import ROOT

KIND = r'"((?:trip|mission|drone|action|brain)\.[a-z]+|stopped|log)"'
"""How the kinds of events are written where they are noted."""

HEADER = {"t": 0.0, "event": "journal.begun", "app": "alfalfa", "sim": True, "seed": 3}
NORTH = {"mission": "North", "trip": "A", "drone": "cf1"}
EVENTS: list[dict[str, object]] = [
    {"t": 0.0, "event": "mission.created", "mission": "North", "trips": ["A", "B"]},
    {"t": 0.5, "event": "trip.allocated", **NORTH, "why": "nearest of 2"},
    {"t": 0.5, "event": "trip.launched", **NORTH, "round": 0, "attempt": 1},
    {"t": 9.25, "event": "mission.uncertain", **NORTH, "reason": "was it released?"},
    {"t": 10.0, "event": "a.word.of.later", "mission": "North", "what": "\x1b[2J"},
    {"t": 11.0, "event": "trip.failed", "mission": "North"},
]

Printed = Callable[..., tuple[int, list[str], str]]


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    with monkeypatch.context() as patch:
        patch.setenv("TZ", "UTC")
        time.tzset()
        yield
    time.tzset()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "J"
    store = Store.create(path, HEADER, clock=lambda: 45_296.5)
    for event in EVENTS:
        store.append([Entry(json.dumps([event]))])
    store.close()
    return path


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Printed:
    def run(*argv: object) -> tuple[int, list[str], str]:
        code = main(APP, ["journal", *[str(word) for word in argv]])
        out, err = capsys.readouterr()
        return code, out.splitlines(), err

    return run


def test_people_read_a_sentence_for_each_event(path: Path, printed: Printed) -> None:
    assert printed(path) == (
        0,
        [
            "12:34:56  journal of alfalfa, begun on 1970-01-01 (simulated drones, seed 3)",
            "12:34:56       0.0 s  North: has trips A, B",
            "12:34:56       0.5 s  North: trip A gets cf1: nearest of 2",
            "12:34:56       0.5 s  North: trip A launched (cf1)",
            "12:34:56       9.2 s  North: waits for a person: was it released?",
            "12:34:56      10.0 s  a.word.of.later: mission North, what \\x1b[2J",
            "12:34:56      11.0 s  trip.failed: mission North",
        ],
        "",
    )


def test_programs_read_an_object_for_each_event(path: Path, printed: Printed) -> None:
    code, lines, _ = printed(path, "--json")
    assert code == 0
    assert [json.loads(line) for line in lines] == [
        {**event, "wall": 45_296.5} for event in [HEADER, *EVENTS]
    ]


def test_only_programs_read_measurements(path: Path, printed: Printed) -> None:
    measured = {"t": 12.0, "event": "drone.flew", "drone": "cf1", "what": "land", "seconds": 4.0}
    store = Store.open(path)
    store.append([Entry(json.dumps([measured]))])
    store.close()
    assert len(printed(path)[1]) == 1 + len(EVENTS)
    assert measured.items() <= json.loads(printed(path, "--json")[1][-1]).items()


def test_without_a_name_it_is_the_newest(
    path: Path, printed: Printed, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    code, _, err = printed()
    assert (code, "there is no journal in" in err) == (2, True)
    path.rename(place.new("alfalfa", 0.0))
    assert len(printed()[1]) == 1 + len(EVENTS)


def test_of_a_damaged_journal_what_can_be_read_is_printed_and_it_ends_with_1(
    path: Path, printed: Printed
) -> None:
    with closing(sqlite3.connect(path)) as database:
        database.execute("DELETE FROM event WHERE seq = 3")
        database.commit()
    code, lines, err = printed(path)
    assert (code, len(lines)) == (1, 3)
    assert err.startswith(f"{path}: the journal is damaged: entry 3 cannot be found.")
    assert "there is no whole copy beside it" in err


def noted() -> Iterator[str]:
    """Yield every kind of event that anything in the runtime or in a block can note."""
    for folder in ("runtime", "stdlib_blocks/plutoc_blocks"):
        for file in sorted((ROOT / folder).rglob("*.py")):
            if file.parent.name != "files" and file.name != "files.py":
                yield from re.findall(KIND, file.read_text())
    yield from (f"drone.{status.value.lower()}" for status in DroneStatus)


class Fact(str):
    """What any fact of an event may be, as far as a sentence looks into it."""

    def __format__(self, spec: str) -> str:
        return "1"

    def __getitem__(self, key: object) -> str:
        return Fact("1")

    def items(self) -> list[tuple[str, str]]:
        return [("1", "1")]


class Facts(dict[str, object]):
    def __missing__(self, key: str) -> object:
        return Fact("1")


def test_every_event_has_a_sentence_of_its_own() -> None:
    kinds = set(noted())
    assert {"trip.launched", "drone.busy", "mission.held", "stopped"} <= kinds
    without = []
    for kind in kinds:
        event = Facts(t=0.0, event=kind, todo=[{"name": "A"}], put=[], gone=["A"])
        said = journal_sentence(event, 0.0)
        if said is not None and said.strip().startswith(f"0.0 s  {kind}"):
            without.append(kind)
    assert without == []


FOLLOW = (
    "import sys\n"
    "from pluto_fleet.cli import main\n"
    "from tests.library.files.an_app import APP\n"
    "sys.exit(main(APP, ['journal', sys.argv[1], '--follow']))\n"
)


def follow(path: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", FOLLOW, str(path)],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(part for part in sys.path if part)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


@pytest.mark.long
def test_what_comes_is_printed_as_it_comes_until_it_is_interrupted(path: Path) -> None:
    following = follow(path)
    assert following.stdout is not None
    for _ in range(1 + len(EVENTS)):
        following.stdout.readline()
    store = Store.open(path)
    for number in range(3):
        store.append([Entry(json.dumps([{"t": 1.0, "event": "log", "text": f"line {number}"}]))])
        assert following.stdout.readline().endswith(f"line {number}\n")
    store.close()
    following.send_signal(signal.SIGINT)
    out, err = following.communicate(timeout=30)
    assert (following.returncode, out, err) == (0, "", "")
