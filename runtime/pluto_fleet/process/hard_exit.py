"""`os._exit` in hooks and blocks ends the process without a word: it must not pass for our own end.

What ends a copy of this process is its own affair.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import NoReturn

leave = os._exit
"""The real one, for ourselves."""


@contextmanager
def refused() -> Iterator[None]:
    """Have `os._exit` raise `SystemExit`, for as long as this lasts: then it is told whose fault it is."""
    instead_of(_refuse)
    try:
        yield
    finally:
        os._exit = leave


def instead_of(call: Callable[[int], NoReturn]) -> None:
    """Have this called whenever something in this process calls `os._exit`."""
    process = os.getpid()

    def end(status: int) -> NoReturn:
        if os.getpid() == process:
            call(status)
        leave(status)

    os._exit = end


def _refuse(status: int) -> NoReturn:
    raise SystemExit(f"os._exit({status})")
