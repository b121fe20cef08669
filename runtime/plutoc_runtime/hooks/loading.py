"""Loading an app whose hooks may be wrong."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath
from types import ModuleType
from typing import TypeVar

from ..domain.errors import BadInput
from ..domain.guard import by_a_person
from ..domain.text import said

T = TypeVar("T")


def loaded(load: Callable[[], T]) -> T:
    """Return the app; raise `BadInput` with the place where its hooks cannot be loaded."""
    try:
        return load()
    except BaseException as error:  # even a SystemExit: it would pass for a proper end
        why = None if by_a_person(error) else _explained(error)
        if why is None:
            raise
        raise BadInput(why) from error


def _explained(error: BaseException) -> str | None:
    """Return the message for an error of the hooks' module; None: the error is elsewhere."""
    from traceback import extract_tb  # only where something has gone wrong

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
