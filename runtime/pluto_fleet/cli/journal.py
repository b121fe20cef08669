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
from ..journal.copies import newest_whole
from ..journal.reader import Reader
from ..report.sentences import journal_sentence
from ..shared import output

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..app import App
    from ..journal.database import Instant
    from .options import Options

DAMAGED = 1

LOOK_EVERY = 0.2
"""The polling interval of `--follow`, in seconds."""


def journal(app: App, options: Options) -> int:
    """Print the journal; with `--follow`, new events as well."""
    path = options.journal or place.newest(app.name)
    with closing(Reader(path, follows=options.follow)) as reader:
        lines = as_json if options.json else as_text
        _print(reader.instants(), lines)
        with suppress(KeyboardInterrupt):
            while options.follow and reader.damaged is None:
                _wait(LOOK_EVERY)
                _print(reader.instants(), lines)
        if reader.damaged is None:
            return 0
        output.flush()
        output.tell(str(errors.damaged(path, reader.damaged, newest_whole(path))))
        return DAMAGED


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


def _print(
    instants: Iterator[Instant], lines: Callable[[dict[str, Any], float], Iterator[str]]
) -> None:
    for instant in instants:
        try:
            events = instant.events
        except ValueError as error:
            output.flush()
            output.tell(f"… {errors.unfit(instant.seq, error)} …")
            continue
        for event in events:
            for line in lines(event, instant.wall):
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
