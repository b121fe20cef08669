"""Journals to damage, and disks without room."""

from __future__ import annotations

import json
import resource
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from pluto_fleet.journal.store import Entry, Store

HEADER = {"t": 0.0, "event": "journal.begun", "app": "alfalfa"}
FILES = ("J", "J-wal")


def text(number: int) -> str:
    """Make the events of an instant; some do not fit into a page."""
    said = "x" * (9_000 if number % 20 == 7 else number % 90)
    return json.dumps([{"t": float(number), "event": "log", "text": said}])


def entry(number: int) -> Entry:
    """Make an entry, with a drone's row."""
    return Entry(text(number), [("drone", (f"cf{number % 7}",), {"trips": number})])


TEXTS = [json.dumps([HEADER])] + [text(number) for number in range(1, 121)]


def written(folder: Path) -> Store:
    """Write the entries, most of them out of the log; the store is left open."""
    store = Store.create(folder / "J", HEADER, clock=lambda: 1_000.0)
    for first in range(1, 101, 10):
        store.append([entry(number) for number in range(first, first + 10)])
    with closing(sqlite3.connect(folder / "J")) as other:
        other.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    for first in range(101, 121, 4):
        store.append([entry(number) for number in range(first, first + 4)])
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
