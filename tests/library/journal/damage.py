"""Journals to damage, and what must hold of one that was."""

from __future__ import annotations

import json
import resource
import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.reader import Reader
from pluto_fleet.journal.store import Store

HEADER = {"event": "journal.begun", "app": "alfalfa"}
LAST_COMMIT = 4
FILES = ("J", "J-wal")


def row(number: int) -> str:
    """Make a row; some do not fit into a page."""
    text = "x" * (9_000 if number % 20 == 7 else number % 90)
    return json.dumps([{"t": float(number), "event": "log", "text": text}])


ROWS = [json.dumps([HEADER])] + [row(number) for number in range(1, 121)]


def written(folder: Path) -> Store:
    """Write the rows, most of them out of the log; the store is left open."""
    store = Store.create(folder / "J", HEADER, clock=lambda: 1_000.0)
    for first in range(1, 101, 10):
        store.append(ROWS[first : first + 10])
        if first == 41:
            store.snapshot("state " + "s" * 5_000)
    with closing(sqlite3.connect(folder / "J")) as other:
        other.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    for first in range(101, 121, LAST_COMMIT):
        store.append(ROWS[first : first + LAST_COMMIT])
    return store


@contextmanager
def full_disk(most: int = 1) -> Iterator[None]:
    """Let no file of this process grow beyond so many bytes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def closed(folder: Path) -> dict[str, bytes]:
    """Return the file of a journal that was closed."""
    written(folder).close()
    return {"J": (folder / "J").read_bytes()}


def killed(folder: Path) -> dict[str, bytes]:
    """Return the files of a journal whose app was killed."""
    store = written(folder)
    try:
        return {name: (folder / name).read_bytes() for name in FILES}
    finally:
        store.close()


def holds(folder: Path, files: dict[str, bytes]) -> tuple[str, int]:
    """Assert that nothing wrong is read of these files; say how they were taken, and what of it."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name, content in files.items():
        (folder / name).write_bytes(content)
    readable = _read(folder / "J")
    return _opened(folder / "J"), readable


def _read(path: Path) -> int:
    try:
        reader = Reader(path)
    except JournalError as error:
        assert str(error).startswith(str(path)), error
        return 0
    found = {found.seq: found.text for found in reader.rows()}
    reader.close()
    assert all(ROWS[seq] == text for seq, text in found.items())
    assert list(found) == sorted(found)
    assert reader.damaged is not None or reader.torn is not None or len(found) == len(ROWS)
    return len(found)


def _opened(path: Path) -> str:
    try:
        store = Store.open(path)
    except JournalError as error:
        assert str(error).startswith(str(path)), error
        return "refused"
    read = store.read()
    found = [found.text for found in read.rows]
    assert store.header == HEADER
    assert found == ROWS[read.after + 1 : read.after + 1 + len(found)]
    assert read.snapshot in (None, "state " + "s" * 5_000)
    assert read.after == (50 if read.snapshot else 0)
    whole = read.after + len(found) == len(ROWS) - 1
    store.close()
    if store.torn is not None:
        assert read.after + len(found) >= len(ROWS) - 1 - LAST_COMMIT
        return "torn"
    assert whole or read.damaged is not None
    return "sound" if whole and read.damaged is None else "damaged"
