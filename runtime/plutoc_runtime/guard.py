"""How the code of the app's developer is called: whatever it raises is its own fault.

Alone, the brain takes every `KeyboardInterrupt` for a person's Ctrl-C. What runs an app in a process
of its own knows more of processes and signals, and puts a guard of its own in place of this one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from .kernel import Cancelled

T = TypeVar("T")

NOT_ITS_OWN = (Cancelled, GeneratorExit, KeyboardInterrupt)
"""What ends coroutines, or the whole app, when it is not a hook that raises it."""


class Guard:
    """What can be known without asking the process."""

    def call(self, code: Callable[[], T]) -> T:
        """Call a hook, or go on with it; it raises nothing that would end more than itself."""
        try:
            return code()
        except NOT_ITS_OWN as error:
            raise self.as_a_fault(error) from error.__cause__

    def is_a_persons(self, error: BaseException) -> bool:
        """Say whether this is a person's Ctrl-C, or, where that cannot be told, may be."""
        return issubclass(type(error), KeyboardInterrupt)  # it is asked nothing: it may be anything

    def as_a_fault(self, error: BaseException) -> BaseException:
        """Return what those who called a hook get for what it raised."""
        if issubclass(type(error), NOT_ITS_OWN) and not self.is_a_persons(error):
            from .words import class_of  # it is needed where something is wrong

            return RuntimeError(f"it may not raise {class_of(error)}")
        return error


_guard = [Guard()]
"""The one by which hooks are called."""


def put(guard: Guard) -> None:
    """Have all hooks called by this guard from now on."""
    _guard[:] = [guard]


def guarded(code: Callable[[], T]) -> T:
    """Call a hook, or go on with it, so that its errors are its own."""
    return _guard[0].call(code)


def by_a_person(error: BaseException) -> bool:
    """Say whether this is a person's Ctrl-C and no error of a hook."""
    return _guard[0].is_a_persons(error)
