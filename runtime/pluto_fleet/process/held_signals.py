"""Signals that arrive while this process forks wait until it has forked.

Python drops what a handler raises in a function that is called at a fork, and prints it: a Ctrl-C would
be lost. To block signals is not enough: they may reach another thread, and Python then calls their
handlers in the main thread nevertheless.
"""

from __future__ import annotations

import os
import signal
import threading
from _thread import interrupt_main
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType
from typing import Any

Handler = Callable[[int, FrameType | None], Any]

BY_A_PERSON = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""The signals that ask a process to end; the first raises, and so its handler is replaced first."""


class Held:
    """Signals that are noted from now on, instead of handled."""

    def __init__(self) -> None:
        self.missed: dict[int, list[int]] = {number: [] for number in BY_A_PERSON}
        """The signals that have arrived: itself by each number, once."""
        self.handlers: dict[int, Handler] = {}
        """The handlers that were there; only the main thread calls them."""
        if threading.current_thread() is threading.main_thread():
            for number in BY_A_PERSON:
                handler = signal.getsignal(number)
                if callable(handler):
                    signal.signal(number, self.note)
                    self.handlers[number] = handler
        self.mask = signal.pthread_sigmask(signal.SIG_BLOCK, BY_A_PERSON)

    def note(self, number: int, _: FrameType | None = None) -> None:
        """Remember that a signal has arrived."""
        self.missed[number][:] = [number]

    def unblock(self) -> None:
        """Let signals arrive again, and note those that were blocked."""
        signal.pthread_sigmask(signal.SIG_SETMASK, self.mask)

    def put_back(self) -> None:
        """Handle signals as before."""
        for number in reversed(self.handlers):
            signal.signal(number, self.handlers[number])


@contextmanager
def held() -> Iterator[Held]:
    """Hold back the signals that ask this process to end; they are handled as this context ends."""
    holds = Held()
    try:
        yield holds
    finally:
        holds.unblock()
        holds.put_back()
        for number in reversed(BY_A_PERSON):
            if holds.missed[number]:
                signal.raise_signal(number)


_forking = threading.local()
_before: dict[int, list[Handler]] = {number: [] for number in BY_A_PERSON}
_missed: dict[int, list[int]] = {number: [] for number in BY_A_PERSON}
"""What the hooks below put back and send again, by signal: one each, or none."""


def _hold() -> None:
    try:
        _forking.held = Held()
    except KeyboardInterrupt:  # it has arrived just before
        _forking.held = Held()
        _forking.held.note(signal.SIGINT)


def _unblock() -> None:
    holds: Held = _forking.held
    for number in BY_A_PERSON:
        handler = holds.handlers.get(number)
        _before[number][:] = [] if handler is None else [handler]
        _missed[number].clear()
    noted, holds.missed = holds.missed, _missed  # where signals are noted from now on
    for number in BY_A_PERSON:
        if noted[number]:
            _missed[number][:] = [number]
    holds.unblock()


def in_child() -> None:
    """Handle signals as the parent did; they stay blocked until `unblock_in_child`."""
    _forking.held.put_back()


def unblock_in_child() -> None:
    """Let signals arrive in a forked child."""
    _forking.held.unblock()


os.register_at_fork(before=_hold, after_in_parent=_unblock)
# These call C functions alone. After the last of them Python handles signals as soon as `os.fork` has
# returned; in a Python function it would do so there.
for _number in reversed(BY_A_PERSON):
    _puts_back: Any = partial(signal.signal, _number)
    os.register_at_fork(after_in_parent=partial(sorted, _before[_number], key=_puts_back))
for _number in BY_A_PERSON:
    _sends: Any = interrupt_main
    os.register_at_fork(after_in_parent=partial(sorted, _missed[_number], key=_sends))
