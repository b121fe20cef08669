"""Whatever a hook raises is the hook's own fault; only a person's Ctrl-C is nobody's."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from .forked import end_if_forked, in_children
from .kernel import Cancelled
from .words import class_of

NOT_ITS_OWN = (Cancelled, GeneratorExit, KeyboardInterrupt)
"""What ends coroutines, or the whole app, when it is not a hook that raises it."""


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


def by_a_person(error: BaseException) -> bool:
    """Say whether this is a person's Ctrl-C, or, where that cannot be told, may be."""
    kind = type(error)  # the error itself is asked nothing: it may be of any class
    if not issubclass(kind, KeyboardInterrupt):
        return False
    handler = signal.getsignal(signal.SIGINT)
    return issubclass(kind, Interrupted) or handler is signal.default_int_handler


def as_a_fault(error: BaseException) -> BaseException:
    """Return what those who called a hook get for what it raised: nothing that would end them."""
    if issubclass(type(error), NOT_ITS_OWN) and not by_a_person(error):
        return RuntimeError(f"it may not raise {class_of(error)}")
    return error


def refuse_if_not_its_own(error: BaseException, parent: int) -> None:
    """Raise a fault instead of an error that would end more than the hook that raised it.

    `parent`: the process that called the hook; a copy of it ends here.
    """
    end_if_forked(parent, error)
    if issubclass(type(error), NOT_ITS_OWN):
        raise as_a_fault(error) from error.__cause__
