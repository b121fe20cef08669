"""Telling errors of hooks from the user's Ctrl-C."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TypeVar

from ..shared.domain.guard import Guard, put_guard
from .forked import end_if_forked, in_children

T = TypeVar("T")


class Interrupted(KeyboardInterrupt):
    """The user pressed Ctrl-C; a type of its own, as hooks may raise `KeyboardInterrupt`."""


@contextmanager
def interrupted_by_a_person() -> Iterator[None]:
    """Make Ctrl-C raise `Interrupted` in this process, within this context."""
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler:  # as with nohup
        yield
        return
    signal.signal(signal.SIGINT, _interrupt)
    no_more = in_children(_as_usual)
    try:
        yield
    finally:
        no_more()
        _as_usual()


def _interrupt(number: int, frame: FrameType | None) -> None:
    raise Interrupted


def _as_usual() -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)


class _InAProcess(Guard):
    """Ends forked copies of the process that return from a hook, and recognises Ctrl-C."""

    def call(self, code: Callable[[], T]) -> T:
        parent = os.getpid()
        try:
            return code()
        except BaseException as error:
            end_if_forked(parent, error)
            raise
        finally:
            end_if_forked(parent)

    def by_a_person(self, error: BaseException) -> bool:
        if not isinstance(error, KeyboardInterrupt):
            return False
        handler = signal.getsignal(signal.SIGINT)
        return isinstance(error, Interrupted) or handler is signal.default_int_handler


IN_A_PROCESS = _InAProcess()
"""The guard of hooks that run in this process."""

by_a_person = IN_A_PROCESS.by_a_person
"""Return whether an error is the user's Ctrl-C, or may be."""


def guard_hooks() -> None:
    """Install this guard for what the library itself calls of an app; an app's brain is given it, too."""
    put_guard(IN_A_PROCESS)
