"""Standard output and standard error, with what can go wrong there."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper


class ClosedPipe(Exception):
    """The reader of the output has gone."""


class CannotWrite(Exception):
    """The output cannot be written, for instance because a disk is full."""


def prepare() -> None:
    """Let no character stop the output: a terminal may not know all letters of a name."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # what is wrong with it will show when it is written to
            with suppress(OSError, ValueError):
                stream.reconfigure(errors="backslashreplace")


def line(text: str = "") -> None:
    """Write a line on standard output."""
    with _told():
        print(text)


def flush() -> None:
    """Send on what was written; only now does a full disk or a closed pipe show."""
    with _told():
        if sys.stdout is not None:
            sys.stdout.flush()


@contextmanager
def _told() -> Iterator[None]:
    """Raise what goes wrong with the output as one of the two errors here."""
    try:
        yield
    except BrokenPipeError as error:
        raise ClosedPipe from error
    except OSError as error:
        raise CannotWrite(error.strerror or str(error)) from error
    except ValueError as error:  # something in this process has closed it
        raise CannotWrite(str(error)) from error


def tell(text: str) -> None:
    """Write a message for a person on standard error; one that cannot be written is dropped."""
    with suppress(OSError, ValueError):
        print(text, file=sys.stderr, flush=True)


def silence() -> None:
    """Drop what is still to be written: Python would try it once more at its end, and complain."""
    with suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
