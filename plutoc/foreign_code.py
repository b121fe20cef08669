"""Loading code of other authors: its faults are its own, and it may not end the compiler."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn


class Terminated(BaseException):
    """We were told to end, by a signal. No `Exception`: code that catches those must let it through."""

    def __init__(self, signal: int) -> None:
        super().__init__(signal)
        self.code = 128 + signal


class Interrupted(KeyboardInterrupt):
    """A person has pressed Ctrl-C: a type of its own, for any code may raise `KeyboardInterrupt`."""


@contextmanager
def isolated() -> Iterator[None]:
    """Have Ctrl-C raise `Interrupted`, and `os._exit` raise `SystemExit`, for as long as this lasts."""
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
    """Say whether this is a person's Ctrl-C, or, where that cannot be told, may be."""
    kind = type(error)  # the error itself is asked nothing: it may be of any class
    if not issubclass(kind, KeyboardInterrupt):
        return False
    handler = signal.getsignal(signal.SIGINT)
    return issubclass(kind, Interrupted) or handler is signal.default_int_handler


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise Interrupted
