"""Appends rows to a journal until it cannot, and says on standard output what was acknowledged.

`python -m tests.library.journal.appender J [bytes that the disk has]`
"""

from __future__ import annotations

import json
import resource
import sys
from itertools import count
from pathlib import Path

from pluto_fleet.journal.errors import JournalError
from pluto_fleet.journal.store import Store
from pluto_fleet.journal.writer import Writer

WHY = json.dumps([{"t": 0.0, "event": "log", "text": "no room"}])


def text(number: int) -> str:
    """Make the row of this number."""
    return json.dumps([{"t": float(number), "event": "log", "text": "x" * (number % 700)}])


def say(word: object) -> None:
    """Say a line, at once."""
    print(word, flush=True)


def main(path: Path, room: int | None) -> None:
    """Append until it is ended."""
    failures: list[JournalError] = []
    try:
        store = Store.open(path) if path.exists() else Store.create(path, {"event": "header"})
        if room is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, resource.RLIM_INFINITY))
        writer = Writer(store, say, failures.append)
        for number in count(store.seq + 1):
            writer.add(text(number))
            if number % 7 == 0:
                writer.flush()
            if number % 500 == 0:
                writer.snapshot(f"state {number}")
    except JournalError as error:
        say(error)
    else:
        return
    if failures:
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
        say(f"last words: {store.last_words(WHY)}")
        writer.close()
        store.close()


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else None)
