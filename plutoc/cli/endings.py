"""The end of the program: exit codes, usage errors, and signals that end it.

That is done by `kill`, by a CI job that is cancelled, by a terminal that is closed.
"""

from __future__ import annotations

import os
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Thread
from types import FrameType

from plutoc.foreign_code import ENDING, Terminated
from plutoc.project.reading import UsageError

__all__ = [
    "CLEAN",
    "CLOSED_PIPE",
    "ERRORS",
    "INTERNAL",
    "INTERRUPTED",
    "REFUSED",
    "USAGE",
    "UsageError",
    "end_at_once_when_told",
    "tidy_when_told_to_end",
]

CLEAN, ERRORS, USAGE, REFUSED, INTERNAL, INTERRUPTED, CLOSED_PIPE = 0, 1, 2, 3, 70, 130, 141


@contextmanager
def tidy_when_told_to_end() -> Iterator[None]:
    """Raise `Terminated` when we are told to end: unfinished work is taken away on its way out.

    A second signal ends the program at once.
    """
    before = {one: signal.getsignal(one) for one in ENDING}
    try:
        for one, handler in before.items():
            if handler == signal.SIG_DFL:  # `nohup` has it ignored, and that shall stay
                signal.signal(one, _terminate)
    except ValueError:  # we are in a thread, where signals are not heard
        yield
        return
    try:
        yield
    finally:
        for one in ENDING:
            if signal.getsignal(one) == _terminate:
                signal.signal(one, signal.SIG_DFL)


def end_at_once_when_told(name: str) -> None:
    """End the program where it is at a signal to end: for a command whose threads cannot be ended.

    One that the caller has ignored stays so, as with `nohup`.
    """

    ends = {one for one in (*ENDING, signal.SIGINT) if signal.getsignal(one) != signal.SIG_IGN}
    heard, told = socket.socketpair()  # Windows wakes up by nothing else
    told.setblocking(False)

    def leave() -> None:
        number = 0
        while number not in ends:
            number = heard.recv(1)[0]
        what = "interrupted" if number == signal.SIGINT else "terminated"
        with suppress(OSError):
            os.write(2, f"{name}: {what}\n".encode())
        os._exit(128 + number)

    for one in ends:
        signal.signal(one, _note)
    # the main thread may be about to wait, and would not run a handler before it is woken
    signal.set_wakeup_fd(told.detach())
    Thread(target=leave, name="signals", daemon=True).start()


def _note(number: int, _: FrameType | None) -> None:
    """Do nothing: Python has sent the signal's number."""


def end_if_told() -> None:
    """Raise `Terminated` once more where a library has dropped it, as code that is no Python may."""
    if _told:
        raise Terminated(_told[-1])


_told: list[int] = []


def _terminate(number: int, _: FrameType | None) -> None:
    signal.signal(number, signal.SIG_DFL)
    _told.append(number)
    raise Terminated(number)
