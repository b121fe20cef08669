"""Appends entries to a journal until it is killed, and says on standard output what was acknowledged.

`python -m tests.library.journal.appender J`
"""

from __future__ import annotations

import json
import sys
from itertools import count
from pathlib import Path

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.store import Entry, Store
from pluto_fleet.journal.writer import Writer


def text(number: int) -> str:
    return json.dumps([{"t": float(number), "event": "log", "text": "x" * (number % 700)}])


def say(word: object) -> None:
    print(word, flush=True)


def fill(store: Store, writer: Writer, number: int) -> None:
    """Add an entry, and now and then wait for the disk, or copy the journal."""
    writer.add(Entry(text(number)))
    if number % 7 == 0:
        writer.flush()
    if number % 500 == 0:
        store.copy()


if __name__ == "__main__":
    path = Path(sys.argv[1])
    failures: list[JournalError] = []
    store = (
        Store.open(path)
        if path.exists()
        else Store.create(path, {"t": 0.0, "event": "journal.begun"})
    )
    writer = Writer(store, say, failures.append)
    for number in count(store.seq + 1):
        fill(store, writer, number)
