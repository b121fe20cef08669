"""`journal`: printing the events of a journal."""

from __future__ import annotations

import json
import select
import sys
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from typing import TYPE_CHECKING, Any

from ..journal import errors, place
from ..journal.mending import mend
from ..journal.reader import Reader
from ..report.sentences import journal_sentence
from ..shared import output
from ..shared.domain.text import counted

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from ..app import App
    from ..journal.database import Row
    from .options import Options

DAMAGED = 1

LOOK_EVERY = 0.2
"""The polling interval of `--follow`, in seconds."""


def journal(app: App, options: Options) -> int:
    """Print the journal; with `--follow`, new events as well."""
    path = options.journal or place.newest(app.name)
    if options.mend:
        output.line(_mended(path))
        return 0
    with closing(Reader(path, follows=options.follow)) as reader:
        printer = _Printer(as_json if options.json else as_text)
        printer.print(reader.rows())
        if options.follow and reader.damaged is None:
            _follow(reader, printer)
    for trouble in (reader.torn, reader.damaged):
        if trouble is not None:
            output.flush()
            output.tell(trouble if trouble.startswith(str(path)) else f"{path}: {trouble}")
    return DAMAGED if reader.damaged is not None else 0


def _mended(path: Path) -> str:
    done = mend(path)
    if done is None:
        return f"{path}: nothing is damaged"
    kept = f"the damaged journal is kept as {done.kept}"
    if not done.lost:
        return f"{path}: mended: {counted(done.rows, 'row')} are there again; {kept}"
    lost = counted(done.lost, "row")
    return (
        f"{path}: mended: {counted(done.rows, 'row')} are there again; {lost} after a gap are left"
        f" out, and resume asks the drones what they did since; {kept}"
    )


def _follow(reader: Reader, printer: _Printer) -> None:
    """Print new events until interrupted, or until the output is closed."""
    with suppress(KeyboardInterrupt):
        while reader.damaged is None:
            _wait(LOOK_EVERY)
            printer.print(reader.more())


def _wait(seconds: float) -> None:
    """Wait for the next poll; notice if the output is closed meanwhile."""
    try:
        watched = select.poll()
        watched.register(sys.stdout.fileno(), 0)  # errors and hang-ups are always reported
    except (AttributeError, OSError, ValueError):  # Windows; an output that is no file
        time.sleep(seconds)
        return
    if watched.poll(seconds * 1000):
        raise output.ClosedPipe


class _Printer:
    """Prints the events of rows, and notes gaps."""

    def __init__(self, lines: Callable[[dict[str, Any], float], Iterator[str]]) -> None:
        self._lines, self._next = lines, 0

    def print(self, rows: Iterator[Row]) -> None:
        for row in rows:
            if row.seq > self._next:
                first, last = self._next, row.seq - 1
                missing = f"row {first}" if first == last else f"rows {first} to {last}"
                output.flush()
                output.tell(f"… {missing} cannot be read …")
            self._next = row.seq + 1
            try:
                events = row.events
            except ValueError as error:
                output.flush()
                output.tell(f"… {errors.unfit(row.seq, error)} …")
                continue
            for event in events:
                for line in self._lines(event, row.wall):
                    output.line(line)
        output.flush()


def as_json(event: dict[str, Any], wall: float) -> Iterator[str]:
    """Format an event as JSON, with the time at which it was written."""
    yield json.dumps({**event, "wall": wall})


def as_text(event: dict[str, Any], wall: float) -> Iterator[str]:
    """Format an event as a sentence, after the local time at which it was written."""
    said = journal_sentence(event, wall)
    if said is not None:
        begin = time.strftime("%H:%M:%S", time.localtime(wall)) + "  "
        for line in said.split("\n"):
            yield begin + line
            begin = " " * len(begin)
