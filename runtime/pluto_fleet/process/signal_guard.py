"""What a hook raises is the hook's own fault; only a person's Ctrl-C is not."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TypeVar

from plutoc_runtime.domain.guard import NOT_ITS_OWN, Guard, as_a_fault, put

from .forked import end_if_forked, in_children

T = TypeVar("T")


class Interrupted(KeyboardInterrupt):
    """A person has pressed Ctrl-C: a type of its own, for a hook may raise `KeyboardInterrupt`."""


@contextmanager
def interrupted_by_a_person() -> Iterator[None]:
    """Have Ctrl-C raise `Interrupted`, in this process and for as long as this lasts."""
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
    """Ends the copies of the process that hooks fork, and tells Ctrl-C from what hooks raise."""

    def call(self, code: Callable[[], T]) -> T:
        parent = os.getpid()
        try:
            returned = code()
        except StopIteration:  # a coroutine's end
            end_if_forked(parent)
            raise
        except BaseException as error:
            end_if_forked(parent, error)
            if not issubclass(type(error), NOT_ITS_OWN):
                raise
            raise as_a_fault(error) from error.__cause__
        end_if_forked(parent)
        return returned

    def by_a_person(self, error: BaseException) -> bool:
        kind = type(error)  # the error itself is asked nothing: it may be of any class
        if not issubclass(kind, KeyboardInterrupt):
            return False
        handler = signal.getsignal(signal.SIGINT)
        return issubclass(kind, Interrupted) or handler is signal.default_int_handler


_IN_A_PROCESS = _InAProcess()

by_a_person = _IN_A_PROCESS.by_a_person
"""Say whether an error is a person's Ctrl-C, or, where that cannot be told, may be."""


def guard_hooks() -> None:
    """Have the brain call hooks as those of an app that runs in this process."""
    put(_IN_A_PROCESS)
