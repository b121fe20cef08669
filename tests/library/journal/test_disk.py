"""What was acknowledged outlives kills and full disks, and nothing else is acknowledged."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import closing
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.journal import place
from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.journal.writer import Writer
from tests.library.journal.appender import fill, text
from tests.library.journal.damage import HEADER, TEXTS, closed, full_disk, killed
from tests.paths import ROOT

PAGE = 4096
WHY = '[{"t": 0.0, "event": "log", "text": "no room"}]'


def appender(path: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "tests.library.journal.appender", str(path)],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT / "runtime")},
        stdout=subprocess.PIPE,
        text=True,
    )


def texts_of(path: Path) -> list[str]:
    """Return all events but the header, and assert that nothing is damaged."""
    with closing(Reader(path)) as reader:
        texts = [instant.text for instant in reader.instants()][1:]
        assert reader.damaged is None
    return texts


@pytest.mark.process
def test_nothing_that_was_acknowledged_is_lost_by_a_kill(tmp_path: Path) -> None:
    path, durable = tmp_path / "J", 0
    for kill in range(3):
        process = appender(path)
        assert process.stdout is not None
        for _ in range(3 + 20 * kill):
            durable = int(process.stdout.readline())
        process.kill()
        said = process.communicate()[0].splitlines()
        durable = int(said[-1]) if said and said[-1].isdigit() else durable
        rows = texts_of(path)
        assert len(rows) >= durable
        assert rows == [text(number) for number in range(1, len(rows) + 1)]
    store = Store.open(path)
    assert store.epoch == 4
    store.close()


@pytest.mark.parametrize("room", [60_000, 300_000, 1_000_000])
def test_on_a_full_disk_nothing_is_acknowledged_and_the_last_words_still_fit(
    room: int, tmp_path: Path
) -> None:
    """Once there is room again, the journal goes on."""
    path, told, failures = tmp_path / "J", [0], list[JournalError]()
    store = Store.create(path, HEADER)
    writer = Writer(store, told.append, failures.append)
    with full_disk(room), pytest.raises(JournalError):
        for number in count(1):
            fill(store, writer, number)
    assert store.last_words(WHY)
    writer.close()
    store.close()
    *rows, last = texts_of(path)
    assert last == WHY
    assert told[-1] <= len(rows)
    assert rows == [text(number) for number in range(1, len(rows) + 1)]
    why = str(failures[0])
    assert why.startswith(f"{path}: the journal cannot be written: the disk")
    assert f"What was written before, {len(rows)} rows, is safe" in why
    assert not place.beside(path, ".reserve").exists()
    store = Store.open(path)
    store.append([Entry('["more"]')])
    store.close()
    assert texts_of(path) == [*rows, WHY, '["more"]']


@pytest.mark.parametrize("room", [1, 8_192, 100_000, 256 * 1024 - 1])
def test_where_there_is_too_little_room_no_part_of_a_journal_is_made(
    room: int, tmp_path: Path
) -> None:
    path = tmp_path / "J"
    with full_disk(room), pytest.raises(JournalError, match="cannot be made: the disk"):
        Store.create(path, HEADER)
    assert os.listdir(tmp_path) == []
    Store.create(path, HEADER).close()
    with full_disk(room), pytest.raises(JournalError, match="cannot be opened: the disk"):
        Store.open(path)
    assert os.listdir(tmp_path) == ["J"]


def test_on_a_disk_that_stays_full_neither_a_copy_nor_a_last_word_is_taken(
    tmp_path: Path,
) -> None:
    """Nothing that the journal took before is lost, and once there is room the last word is heard."""
    path = tmp_path / "J"
    store = Store.create(path, HEADER)
    store.append([Entry(text(1))])
    with full_disk():
        with pytest.raises((OSError, sqlite3.Error)):
            store.copy()
        assert not store.last_words(WHY)
    assert store.last_words(WHY)
    store.close()
    assert texts_of(path) == [text(1), WHY]
    assert os.listdir(tmp_path) == ["J"]


Refuses = Callable[[str], None]


@pytest.fixture
def refuses(monkeypatch: pytest.MonkeyPatch) -> Refuses:
    """Let SQLite open nothing any more whose address ends so: it would have to write, and may not."""

    def refuse(ending: str) -> None:
        connect = sqlite3.connect

        def connected(address: str, **options: Any) -> sqlite3.Connection:
            if address.endswith(ending):
                error = sqlite3.OperationalError()
                error.sqlite_errorcode = sqlite3.SQLITE_CANTOPEN
                raise error
            return connect(address, **options)

        monkeypatch.setattr(sqlite3, "connect", connected)

    return refuse


def test_a_new_journal_that_cannot_be_opened_leaves_nothing_behind(
    tmp_path: Path, refuses: Refuses
) -> None:
    refuses("?mode=rw")
    with pytest.raises(JournalError, match="cannot be made: it may not be opened"):
        Store.create(tmp_path / "J", HEADER)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("log", [True, False])
def test_where_nothing_may_be_written_all_rows_are_read_and_nothing_is_left(
    log: bool, tmp_path: Path, refuses: Refuses, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of an app that was killed, from a copy; if there is no room for that either, it is said."""
    path, copies = tmp_path / "J", tmp_path / "copies"
    files = (killed if log else closed)(tmp_path)
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    copies.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(copies))
    refuses("/J?mode=ro")
    reader = Reader(path, follows=True)
    assert [instant.text for instant in reader.instants()] == TEXTS
    reader.close()
    assert (reader.damaged, os.listdir(copies)) == (None, [])
    with full_disk(PAGE):
        if log:
            with pytest.raises(JournalError, match="cannot be opened: the disk is full"):
                Reader(path)


@pytest.mark.parametrize("meanwhile", [False, True])
def test_where_files_cannot_be_linked_a_journal_takes_the_place_of_none_either(
    meanwhile: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor where another process has just made one of that name."""

    def link(*_: object) -> None:
        raise FileExistsError if meanwhile else PermissionError

    monkeypatch.setattr(os, "link", link)
    if meanwhile:
        with pytest.raises(JournalError, match="there is a journal already"):
            Store.create(tmp_path / "J", HEADER)
    else:
        Store.create(tmp_path / "J", HEADER).close()
    assert os.listdir(tmp_path) == ([] if meanwhile else ["J"])
