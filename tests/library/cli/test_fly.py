"""`fly`, `resume` and `decide`, as far as no drone has to leave for it."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.journal.header import header
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Store
from tests.kit.journals import entry
from tests.kit.told import Told
from tests.library.cli.conftest import MISSIONS, Command
from tests.library.files.an_app import APP

Event = dict[str, Any]
Write = Callable[..., Path]

TRIP = {"name": "A", "action": "take_photo", "target": [2.0, 3.0, 1.2], "index": 0}


def created(name: str, index: int) -> Event:
    plan = {"index": index, "fields": {}, "trips": [{**TRIP}]}
    return {"t": 0.0, "event": "mission.created", "mission": name, "trips": ["A"], "plan": plan}


def ended(name: str, status: str, reason: str = "") -> Event:
    what = {"t": 8.0, "event": "mission.ended", "mission": name}
    return {**what, "status": status, "reason": reason}


LAUNCHED = {"t": 0.0, "event": "trip.launched", "mission": "North", "trip": "A", "drone": "cf1",
            "round": 0, "attempt": 1}  # fmt: skip
DOUBT = {"t": 5.0, "event": "mission.uncertain", "mission": "North", "trip": "A",
         "drone": "cf1", "reason": "was it done?"}  # fmt: skip


@pytest.fixture
def journal(tmp_path: Path) -> Write:
    """Write a journal of these events, a row each."""

    def write(*events: Event, **facts: object) -> Path:
        path = tmp_path / "a.journal"
        whole = header(APP, missions=MISSIONS, fleet=None, sim=True, seed=0)
        with closing(Store.create(path, {**whole, **facts})) as store:
            told = Told()
            store.append([entry([event], told) for event in events])
        return path

    return write


def events_of(path: Path) -> Sequence[Event]:
    with closing(Reader(path)) as reader:
        return [event for _, event in reader.events()]


def test_a_journal_that_is_there_is_never_overwritten(
    missions: Path, journal: Write, command: Command
) -> None:
    """And one is told what to do."""
    path = journal()
    code, out, err = command("fly", missions, "--sim", "--journal", path)
    assert (code, out) == (2, "")
    assert err.startswith(f"{path}: there is a journal already")
    assert "resume" in err


def test_what_an_earlier_flight_has_left_is_not_taken_for_this_ones(
    missions: Path, tmp_path: Path, command: Command
) -> None:
    """Its ledger says of trips of the same names that they were done."""
    left = tmp_path / "a.journal.gateway"
    left.mkdir()
    code, out, err = command("fly", missions, "--sim", "--journal", tmp_path / "a.journal")
    assert (code, out) == (2, "")
    assert err.startswith(f"{left}: it is of an earlier flight")
    assert not (tmp_path / "a.journal").exists()


def test_where_all_missions_have_ended_there_is_nothing_to_resume(
    journal: Write, command: Command
) -> None:
    """The report is printed once more, and it ends as the flight did."""
    path = journal(
        created("North", 0),
        created("South", 1),
        LAUNCHED,
        ended("North", "COMPLETED"),
        ended("South", "FAILED", "no drone can do it"),
    )
    code, out, err = command("resume", path)
    assert (code, err) == (1, "")
    lines = out.splitlines()
    assert lines[0] == "nothing to go on with: every mission has ended"
    assert lines[-1] == "1 of 2 missions completed, 1 failed in 8 s (1 flight)"
    assert any(line.startswith("South") and "no drone can do it" in line for line in lines)


@pytest.mark.parametrize(
    ("facts", "said"),
    [
        ({"app": "wards"}, "this is a journal of wards, and this app is alfalfa"),
        ({"fleet": '[[drone]]\nid = "a"\ncategory = "gone"\nhome = [1, 1]'}, "(its fleet):3: "),
    ],
)
def test_a_journal_that_this_app_cannot_go_on_with_is_refused(
    facts: dict[str, object], said: str, journal: Write, command: Command
) -> None:
    path = journal(created("North", 0), **facts)
    before = events_of(path)
    code, out, err = command("resume", path, "--sim")
    assert (code, out) == (2, "")
    assert said in err
    assert events_of(path) == before


def test_a_flight_of_real_drones_is_not_resumed_with_simulated_ones(
    journal: Write, command: Command
) -> None:
    path = journal(created("North", 0), sim=False)
    said = f"{path}: its drones are real ones: go on without --sim\n"
    assert command("resume", path, "--sim") == (2, "", said)


def test_two_processes_cannot_go_on_with_one_journal(journal: Write, command: Command) -> None:
    path = journal(created("North", 0))
    with closing(Store.open(path)):
        code, _, err = command("resume", path, "--sim")
    assert code == 2
    assert "only one at a time may" in err


@pytest.mark.parametrize(
    ("name", "typed"),
    [
        ("North field, 2", '"North field, 2"'),
        ("$(reboot)", "'$(reboot)'"),
        ('the "so-called" `field`', "'the \"so-called\" `field`'"),
        ("--help", '-- "--help"'),
        ("x" * 100, f'"{"x" * 100}"'),
    ],
)
def test_under_any_name_of_a_mission_what_is_said_to_be_typed_runs_nothing_else(
    name: str, typed: str, journal: Write, command: Command
) -> None:
    facts = {"mission": name}
    path = journal(created(name, 0), {**LAUNCHED, **facts}, {**DOUBT, **facts})
    _, out, _ = command("decide", path)
    assert out.splitlines()[1] == f"  alfalfa decide {path} {typed} done"


def test_nothing_is_decided_in_a_damaged_journal(journal: Write, command: Command) -> None:
    """Neither listed nor written down: what is missing may be what it was about."""
    path = journal(created("North", 0), LAUNCHED, DOUBT)
    with closing(sqlite3.connect(path)) as database:
        database.execute("UPDATE mission SET text = '[]'")
        database.commit()
    for words in (), ("North", "done"):
        code, out, err = command("decide", path, *words)
        assert (code, out) == (2, "")
        assert "the row of mission North is not as this version knows it" in err


def test_a_decision_is_put_down_in_a_journal_at_rest(journal: Write, command: Command) -> None:
    path = journal(created("North", 0), LAUNCHED, DOUBT)
    code, out, err = command("decide", path, "North", "not-done")
    assert (code, err) == (0, "")
    assert "it is on record" in out
    decided = events_of(path)[-1]
    assert (decided["event"], decided["mission"]) == ("mission.decided", "North")
    assert (decided["t"], decided["answer"]) == (5.0, "not-done")
    assert command("decide", path) == (0, "no mission waits for a person\n", "")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("South done", 'mission "South" waits for no decision'),
        ("East done", 'mission "East" is not in this journal; those that wait are: "North"'),
        ("North", "was it done?; say one of: done, not-done, cancel"),
        ("North go-on", "was it done?; say one of: done, not-done, cancel"),
    ],
)
def test_a_decision_that_was_not_asked_for_is_refused(
    words: str, said: str, journal: Write, command: Command
) -> None:
    path = journal(created("North", 0), created("South", 1), LAUNCHED, DOUBT)
    before = events_of(path)
    code, out, err = command("decide", path, *words.split())
    assert (code, out) == (2, "")
    assert said in err
    assert events_of(path) == before
