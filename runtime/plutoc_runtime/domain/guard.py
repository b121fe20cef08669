"""How the code of the app's developer is called: what it raises is its own fault.

Alone, the brain takes every `KeyboardInterrupt` for a person's Ctrl-C. A library that runs an app in a
process knows more of that process and its signals, and puts a guard of its own here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from .errors import Cancelled

T = TypeVar("T")

NOT_ITS_OWN = (Cancelled, GeneratorExit, KeyboardInterrupt)
"""What ends coroutines, or the whole app, when it is not a hook that raises it."""


class Guard:
    """Calls hooks, and knows of their errors only what they are."""

    def call(self, code: Callable[[], T]) -> T:
        """Call a hook, or go on with it; it raises nothing that would end more than itself."""
        try:
            return code()
        except NOT_ITS_OWN as error:
            raise as_a_fault(error) from error.__cause__

    def by_a_person(self, error: BaseException) -> bool:
        """Say whether this is a person's Ctrl-C, or, where that cannot be told, may be."""
        return issubclass(type(error), KeyboardInterrupt)  # it is asked nothing: it may be anything


_guard = Guard()


def put(guard: Guard) -> None:
    """Have all hooks called by this guard from now on."""
    global _guard
    _guard = guard


def guarded(code: Callable[[], T]) -> T:
    """Call a hook, or go on with it, so that its errors end nothing else."""
    return _guard.call(code)


def by_a_person(error: BaseException) -> bool:
    """Say whether this is a person's Ctrl-C and no error of a hook."""
    return _guard.by_a_person(error)


def as_a_fault(error: BaseException) -> BaseException:
    """Return what those who called a hook get for what it raised: nothing that would end them."""
    if issubclass(type(error), NOT_ITS_OWN) and not by_a_person(error):
        name: str = type.__dict__["__name__"].__get__(type(error))  # a class may refuse to say it
        return RuntimeError(f"it may not raise {name[:_LONGEST]}")
    return error


def unless_by_a_person(error: BaseException) -> None:
    """Raise a person's Ctrl-C on; all else is an error of the object that was asked something."""
    if by_a_person(error):
        raise error


_LONGEST = 60
"""Characters of a class's name."""
