"""The writer acknowledges an entry once it is durable, and takes many at once."""

from __future__ import annotations

import json
from contextlib import closing
from pathlib import Path

import pytest

from pluto_fleet.journal.copies import newest_whole
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.journal.writer import Writer


def text(number: int) -> str:
    return json.dumps([{"t": float(number), "event": "log"}])


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store.create(tmp_path / "J", {"t": 0.0, "event": "journal.begun"})


def test_entries_have_numbers_and_are_durable_in_order(store: Store) -> None:
    told: list[tuple[int, int]] = []
    failures: list[JournalError] = []
    writer = Writer(store, lambda number: told.append((number, store.seq)), failures.append)
    assert [writer.add(Entry(text(number))) for number in range(1, 2001)] == list(range(1, 2001))
    writer.flush()
    writer.close()
    assert told[-1] == (2000, 2000)
    assert all(number <= durable for number, durable in told)
    assert sorted(told) == told
    with closing(Reader(store.path)) as reader:
        texts = [instant.text for instant in reader.instants()][1:]
    assert texts == [text(number) for number in range(1, 2001)]
    assert not failures
    store.close()


def test_a_copy_has_all_that_was_added_before_it(store: Store) -> None:
    for number in (1, 2):
        store.append([Entry(text(number))])
    store.copy()
    store.close()
    whole = newest_whole(store.path)
    assert whole is not None
    with closing(Reader(whole[0])) as reader:
        assert [instant.text for instant in reader.instants()][1:] == [text(1), text(2)]


def test_an_entry_that_cannot_be_written_stops_everything_instead_of_waiting_for_ever(
    store: Store,
) -> None:
    failures: list[JournalError] = []
    writer = Writer(store, lambda _: None, failures.append)
    writer.add(Entry("half of a letter: \ud800"))
    with pytest.raises(JournalError, match="cannot be written"):
        writer.flush()
    writer.close()
    assert len(failures) == 1
    assert store.last_words(text(1))
    store.close()
