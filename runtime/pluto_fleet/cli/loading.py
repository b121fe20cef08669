"""Loads the app, its developer's own code with it, and says what keeps it from being loaded."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import PurePath
from types import ModuleType
from typing import TYPE_CHECKING, NoReturn

from plutoc_runtime.errors import BadInput
from plutoc_runtime.hooks import said

from ..hard_exit import refused
from ..raised import by_a_person, interrupted_by_a_person

if TYPE_CHECKING:
    from plutoc_runtime.app import App

HOOKS = "hooks.py"


def bare(name: str) -> App:
    """Return an app of which nothing but the name is known, for commands that need no more."""
    from plutoc_runtime.app import App
    from plutoc_runtime.model import Mission, Trip

    def flow(_: object) -> NoReturn:
        raise RuntimeError("nothing flies here")

    return App(
        name=name,
        title=name,
        flow=flow,
        mission=Mission,
        trip=Trip,
        fields=(),
        categories=(),
        actions={},
    )


def loaded(load: Callable[[], App]) -> App:
    """Return the app; raise `BadInput` with the place where its hooks cannot be loaded."""
    with interrupted_by_a_person(), refused():
        try:
            return load()
        except BaseException as error:  # even a SystemExit: it would pass for a proper end
            said = None if by_a_person(error) else _explained(error)
            if said is None:
                raise
            raise BadInput(said) from error


def _explained(error: BaseException) -> str | None:
    """Return what is wrong with the hooks; None: something else is wrong."""
    if isinstance(error, AttributeError) and isinstance(error.obj, ModuleType):
        file = error.obj.__file__ or ""
        if PurePath(file).name == HOOKS:
            return f"{file} has no {error.name}: write it; plutoc compile --add-stubs adds a stub"
    if isinstance(error, SyntaxError) and PurePath(error.filename or "").name == HOOKS:
        return f"{error.filename}:{error.lineno}: {error.msg}"
    frames = [f for f in traceback.extract_tb(error.__traceback__) if _is_hooks(f.filename)]
    if not frames:
        return None
    place = f"{frames[-1].filename}:{frames[-1].lineno}"
    return f"{place}: the hooks cannot be loaded: {said(error)}"


def _is_hooks(filename: str) -> bool:
    path = PurePath(filename)
    return path.name == HOOKS and path.parent.name != "_runtime"
