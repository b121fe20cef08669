"""Loading code of other authors, whose errors must not end the compiler."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

ENDING = tuple(one for one in signal.Signals if one.name in ("SIGTERM", "SIGHUP"))
"""The signals that ask the compiler to end; Windows has no SIGHUP."""


class Terminated(BaseException):
    """A signal asks the compiler to end. Not an `Exception`, so that code which catches those lets it through."""

    def __init__(self, signal: int) -> None:
        super().__init__(signal)
        self.code = 128 + signal


class Interrupted(KeyboardInterrupt):
    """The user pressed Ctrl-C; a type of its own, as any code may raise `KeyboardInterrupt`."""


@contextmanager
def isolated() -> Iterator[None]:
    """Make Ctrl-C raise `Interrupted`, and `os._exit` raise `SystemExit`, within this context."""
    leave, process = os._exit, os.getpid()

    def refuse(status: int) -> NoReturn:
        if os.getpid() == process:
            raise SystemExit(f"os._exit({status})")
        leave(status)  # what ends a copy of this process is its own affair

    before = signal.getsignal(signal.SIGINT)
    if before is signal.default_int_handler:  # it is not with nohup
        signal.signal(signal.SIGINT, _interrupt)
    os._exit = refuse
    try:
        yield
    finally:
        os._exit = leave
        if before is signal.default_int_handler:
            signal.signal(signal.SIGINT, before)


def by_a_person(error: BaseException) -> bool:
    """Return whether this is the user's Ctrl-C, or may be."""
    kind = type(error)  # not `isinstance`: the error's class may lie
    if not issubclass(kind, KeyboardInterrupt):
        return False
    handler = signal.getsignal(signal.SIGINT)
    return issubclass(kind, Interrupted) or handler is signal.default_int_handler


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise Interrupted
