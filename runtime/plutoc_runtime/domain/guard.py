"""How hooks are called: an error that they raise is theirs.

Alone, the brain takes every `KeyboardInterrupt` for the user's Ctrl-C. The library handles the signals
of its process, and installs a guard of its own here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from .errors import Cancelled

T = TypeVar("T")

NOT_ITS_OWN = (Cancelled, GeneratorExit, KeyboardInterrupt)
"""What ends a coroutine, or the whole app, unless it is a hook that raises it."""


class Guard:
    """Calls hooks, and tells their errors from the user's Ctrl-C by the type alone."""

    def call(self, code: Callable[[], T]) -> T:
        """Call a hook, or resume it."""
        return code()

    def by_a_person(self, error: BaseException) -> bool:
        """Return whether this is the user's Ctrl-C, or may be."""
        return isinstance(error, KeyboardInterrupt)


_guard = Guard()


def put_guard(guard: Guard) -> None:
    """Install this guard for all hooks of this brain's app."""
    global _guard
    _guard = guard


def guarded(code: Callable[[], T]) -> T:
    """Call a hook, or resume it, with the installed guard; its errors end nothing but the hook."""
    try:
        return _guard.call(code)
    except NOT_ITS_OWN as error:
        raise as_a_fault(error) from error.__cause__


def by_a_person(error: BaseException) -> bool:
    """Return whether this is the user's Ctrl-C and not an error of a hook."""
    return _guard.by_a_person(error)


def as_a_fault(error: BaseException) -> BaseException:
    """Return the error that a hook's caller gets for what it raised: one that does not end the caller."""
    if isinstance(error, NOT_ITS_OWN) and not by_a_person(error):
        return RuntimeError(f"it may not raise {type(error).__name__}")
    return error


def unless_by_a_person(error: BaseException) -> None:
    """Raise the user's Ctrl-C again; any other error belongs to the hook."""
    if by_a_person(error):
        raise error
