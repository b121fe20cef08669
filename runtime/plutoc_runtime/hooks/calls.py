"""Calling the app's hooks, and turning their faults into errors."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from types import ModuleType
from typing import TYPE_CHECKING, Any, TypeVar

from ..domain.errors import ANY_ERROR, ActionFailed, BadInput, HookFault
from ..domain.guard import by_a_person, unless_by_a_person
from ..domain.text import bounded, class_of, text_of

if TYPE_CHECKING:
    from ..domain.model import Mission

T = TypeVar("T")

Hook = Callable[..., object]


class ProtectedFacts:
    """Attributes that a hook may not change, such as names: saved before the call."""

    def __init__(self, of: object, *facts: str) -> None:
        self._of, self._facts = of, {fact: getattr(of, fact) for fact in facts}

    def put_back(self) -> str:
        """Restore them; return the name of one that was changed, or nothing."""
        changed = ""
        for fact, value in self._facts.items():
            if getattr(self._of, fact, None) is not value:
                setattr(self._of, fact, value)
                changed = changed or fact
        return changed


def changed(hook: Hook, what: str, fact: str) -> HookFault:
    """Return the fault of a hook that changed a protected attribute."""
    return HookFault(f"hook {hook_name(hook)} changed the {what}'s {fact}, by which it is known")


def look(hook: Hook, note: Callable[[Mission[Any]], object], mission: Mission[Any]) -> None:
    """Record what a hook has changed; a change that cannot be stored is a fault of the hook."""
    try:
        note(mission)
    except ANY_ERROR as error:
        unless_by_a_person(error)
        reason = f"hook {hook_name(hook)} left its mission so that it cannot be kept: {said(error)}"
        raise HookFault(reason, trace_of(error)) from None


def fault_of(hook: Hook, error: BaseException) -> HookFault:
    """Return the error for what a hook raised.

    Even `SystemExit` is a fault: it would end all flights. A `KeyboardInterrupt` is the user's.
    """
    if issubclass(type(error), ActionFailed):
        text = bounded(text_of(error), LONGEST_REASON)
        reason = f"hook {hook_name(hook)} raised ActionFailed, which only an action may: {text}"
    else:
        reason = f"hook {hook_name(hook)} raised {said(error)}"
    return HookFault(reason, trace_of(error))


def said(error: BaseException) -> str:
    """Return an error's type and text."""
    text = f"{class_of(error)}: {text_of(error)}".removesuffix(": ")
    return bounded(text, LONGEST_REASON)


def hook_name(hook: Hook) -> str:
    """Return a hook's name, as declared."""
    inner = getattr(hook, "func", hook)  # functools.partial carries its function so
    return str(getattr(inner, "__name__", inner))


def trace_of(error: BaseException) -> str:
    """Return the traceback of a hook's error, for the log."""
    import traceback  # not needed by those who only declare blocks

    try:
        if all(type(given) in (str, int, float) for given in error.args):
            return bounded("".join(traceback.format_exception(error)).rstrip(), LONGEST_LOG)
    except ANY_ERROR as its_own:
        unless_by_a_person(its_own)
    # Python would ask what it was given how it is written, which may take for ever
    through = BaseException.__dict__["__traceback__"].__get__(error)
    lines = ["Traceback (most recent call last):\n", *traceback.format_tb(through)]
    return bounded("".join(lines), LONGEST_LOG) + said(error)


LONGEST_REASON, LONGEST_LOG = 2_000, 20_000
"""Characters of what a hook says of a failure, and of a line that it has logged."""


def loaded(load: Callable[[], T]) -> T:
    """Return the app; raise `BadInput` with the place where its hooks cannot be loaded."""
    try:
        return load()
    except BaseException as error:  # even a SystemExit: it would pass for a proper end
        said = None if by_a_person(error) else _explained(error)
        if said is None:
            raise
        raise BadInput(said) from error


def _explained(error: BaseException) -> str | None:
    """Return the message for an error of the hooks' module; None: the error is elsewhere."""
    from traceback import extract_tb  # not needed by those who only declare blocks

    if isinstance(error, AttributeError) and isinstance(error.obj, ModuleType):
        file = error.obj.__file__
        if _is_hooks(file):
            return f"{file} has no {error.name}: write it; plutoc compile --add-stubs adds a stub"
    if isinstance(error, SyntaxError) and _is_hooks(error.filename):
        return f"{error.filename}:{error.lineno}: {error.msg}"
    frames = [f for f in extract_tb(error.__traceback__) if _is_hooks(f.filename)]
    if not frames:
        return None
    place = f"{frames[-1].filename}:{frames[-1].lineno}"
    why = f"{place}: the hooks cannot be loaded: {said(error)}"
    if isinstance(error, ModuleNotFoundError):
        why += "; install it, and name it in the app's source, by the name that pip knows: requires"
    return why


def _is_hooks(file: str | None) -> bool:
    return PurePath(file or "").name == "hooks.py"
