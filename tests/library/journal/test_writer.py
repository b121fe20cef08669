"""The writer acknowledges a row once it is durable, and takes many at once."""

from __future__ import annotations

import json
from pathlib import Path
from threading import Event

import pytest

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.store import Store
from pluto_fleet.journal.writer import Writer


def row(number: int) -> str:
    return json.dumps([{"t": float(number), "event": "log"}])


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store.create(tmp_path / "J", {"event": "journal.begun"})


def test_rows_have_numbers_and_are_durable_in_order(store: Store) -> None:
    told: list[tuple[int, int]] = []
    failures: list[JournalError] = []
    writer = Writer(store, lambda number: told.append((number, store.seq)), failures.append)
    assert [writer.add(row(number)) for number in range(1, 2001)] == list(range(1, 2001))
    writer.flush()
    writer.close()
    assert told[-1] == (2000, 2000)
    assert all(number <= durable for number, durable in told)
    assert sorted(told) == told
    assert [found.text for found in store.read().rows] == [row(n) for n in range(1, 2001)]
    assert not failures
    store.close()


def test_a_snapshot_stands_for_the_rows_before_it_though_others_are_written_with_it(
    store: Store,
) -> None:
    busy, written = Event(), Event()

    def told(number: int) -> None:
        busy.set()
        assert written.wait(60)  # meanwhile more is added, and taken in one batch

    writer = Writer(store, told, list[JournalError]().append)
    writer.add(row(1))
    assert busy.wait(60)
    writer.add(row(2))
    writer.snapshot("of two")
    writer.add(row(3))
    written.set()
    writer.flush()
    writer.close()
    read = store.read()
    assert (read.snapshot, [found.text for found in read.rows]) == ("of two", [row(3)])
    store.close()


def test_a_row_that_cannot_be_written_stops_everything_instead_of_waiting_for_ever(
    store: Store,
) -> None:
    failures: list[JournalError] = []
    writer = Writer(store, lambda _: None, failures.append)
    writer.add("half of a letter: \ud800")
    with pytest.raises(JournalError, match="cannot be written"):
        writer.flush()
    writer.close()
    assert len(failures) == 1
    assert store.last_words(row(1))
    store.close()
