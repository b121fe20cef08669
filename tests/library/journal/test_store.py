"""A journal keeps what it acknowledged, in order, and belongs to one process."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import pytest

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.lock import holder
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Entry, Store

HEADER = {
    "t": 0.0,
    "event": "journal.begun",
    "app": "alfalfa",
    "missions": '[[mission]]\nname = "Ä"',
}

FULL = 2
"""Of SQLite's `synchronous`: a commit returns when the disk has it."""


def text(number: int) -> str:
    return json.dumps([{"t": float(number), "event": "log", "text": f"number {number}"}])


def entry(number: int) -> Entry:
    return Entry(text(number), [("drone", ("cf1",), {"trips": number})])


@pytest.fixture
def place(tmp_path: Path) -> Path:
    return tmp_path / "flight.journal"


@pytest.fixture
def store(place: Path) -> Iterator[Store]:
    store = Store.create(place, HEADER, clock=lambda: 1_000.25)
    yield store
    store.close()


def test_what_was_appended_is_read_in_another_life(store: Store, place: Path) -> None:
    store.append([entry(1), entry(2)])
    store.append([entry(3)])
    store.close()
    again = Store.open(place)
    assert (again.header, again.written, again.standing().flown) == (HEADER, 1000.25, {"cf1": 3})
    again.close()
    with closing(Reader(place)) as reader:
        found = [(one.seq, one.wall, one.text) for one in reader.instants()][1:]
    assert found == [(number, 1000.25, text(number)) for number in (1, 2, 3)]


class Watched(sqlite3.Connection):
    """A database that notes whether it waits for the disk when it commits."""

    waits: ClassVar[list[bool]] = []

    def execute(self, sql: str, /, *parameters: Any) -> sqlite3.Cursor:
        if sql == "COMMIT":
            (mode,) = super().execute("PRAGMA synchronous").fetchone()
            self.waits.append(mode >= FULL)
        return super().execute(sql, *parameters)


def test_all_that_is_committed_is_on_the_disk_by_then(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A row that was acknowledged, the header, and each epoch: the power may fail right after."""
    Watched.waits.clear()
    monkeypatch.setattr(sqlite3, "connect", partial(sqlite3.connect, factory=Watched))
    store = Store.create(place, HEADER)
    store.append([entry(1)])
    store.close()
    assert Watched.waits == [True] * 3


def test_the_epoch_grows_at_each_opening_even_if_nothing_is_written(place: Path) -> None:
    epochs = []
    store = Store.create(place, HEADER)
    for _ in range(3):
        epochs.append(store.epoch)
        store.close()
        store = Store.open(place)
    store.close()
    assert epochs == [1, 2, 3]


def test_a_second_writer_is_told_who_the_first_one_is(store: Store, place: Path) -> None:
    with pytest.raises(JournalError, match=f"process {os.getpid()} is writing this journal"):
        Store.open(place)
    link = place.with_name("another name")
    link.symlink_to(place)
    with pytest.raises(JournalError, match=f"process {os.getpid()} is writing"):
        Store.open(link)
    assert holder(place) == os.getpid()
    store.close()
    assert holder(place) is None


def test_a_reader_that_stops_in_the_middle_keeps_no_one_from_tidying_up(
    store: Store, place: Path
) -> None:
    store.append([entry(number) for number in range(3_000)])
    reader = Reader(place)
    instants = reader.instants()
    next(instants)
    store.append([entry(3_000)])
    store.close()
    assert place.with_name(f"{place.name}-wal").stat().st_size == 0
    assert sum(1 for _ in instants) == 3_000  # what was there when it began
    assert sum(1 for _ in reader.instants()) == 1
    reader.close()


@pytest.mark.parametrize("suffix", ["", "-wal"])
@pytest.mark.parametrize("replaced", [False, True])
def test_a_journal_that_was_deleted_takes_nothing_more(
    suffix: str, replaced: bool, store: Store, place: Path
) -> None:
    """Also when another file has its name by now, and though nothing is being written."""
    store.append([entry(1)])
    gone = place.with_name(place.name + suffix)
    gone.unlink()
    if replaced:
        gone.write_text("something else")
    with pytest.raises(JournalError, match=f"{gone}: it was deleted"):
        store.look()
    with pytest.raises(JournalError, match="it was deleted"):
        store.append([entry(2)])


@pytest.mark.parametrize("text", ["", "something else"])
def test_a_journal_that_was_emptied_or_written_over_takes_nothing_more(
    text: str, store: Store, place: Path
) -> None:
    """It is the same file still, and the database goes on writing beside it."""
    store.append([entry(1)])
    place.write_text(text)
    with pytest.raises(JournalError, match=f"{place}: it was cut short or written over"):
        store.look()
    with pytest.raises(JournalError, match="cut short"):
        store.append([entry(2)])


def test_a_journal_that_was_renamed_is_called_by_its_new_name(store: Store, place: Path) -> None:
    moved = place.rename(place.with_name("elsewhere"))
    with pytest.raises(JournalError, match=f"^{moved}: .* moved away from {place}: move it back"):
        store.append([entry(1)])
    moved.rename(place)
    store.close()
    Store.open(place).close()


def test_what_is_no_text_and_what_is_a_very_long_number_are_kept_in_rows(place: Path) -> None:
    """Half of a character is no text: it becomes a question mark."""
    store = Store.create(place, HEADER)
    drone = {"lost": {"reason": "half \ud800", "at": None}, "trips": 2**80}
    store.append([Entry(text(1), [("drone", ("cf1",), drone)])])
    assert store.standing().lost == {"cf1": {"reason": "half ?", "at": None}}
    assert store.standing().flown == {"cf1": 2**80}
    store.close()
