"""Loading the navigation or localization class that a fleet file names; nothing of it is called.

Its module is imported after a check that it has such a class (`inspection.py`).

A name is a built-in one (`crazyflie`), an entry point of an installed package, or `module:Class`. Only
installed modules are found: a fleet file is data, and its folder is no place for code.
"""

from __future__ import annotations

import inspect
import os
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, TypeVar, cast

from ..shared.domain.errors import ANY_ERROR, BadInput
from ..shared.domain.text import quoted
from . import plugins
from .inspection import look_up, problems, try_import
from .plugins import CAPABILITIES, LOCALIZATION_METHODS, NAVIGATION_METHODS, PluginKind
from .protocol import Addressed
from .timeouts import shortened

if TYPE_CHECKING:
    from .localization import Localization
    from .protocol import DroneNavigation, DroneSetup

S = TypeVar("S")
T = TypeVar("T")


NAVIGATION = PluginKind(
    word="navigation",
    ours=(("crazyflie", "..crazyflie.navigation:Crazyflie"),),
    group="plutoc.navigations",
    argument="setup",
    such_as="my_drones.parrot:Parrot",
    methods=NAVIGATION_METHODS,
    together=CAPABILITIES,
)
LOCALIZATION = PluginKind(
    word="localization",
    group="plutoc.localizations",
    argument="options",
    such_as="my_cameras:Ceiling",
    methods=LOCALIZATION_METHODS,
)


def load_navigation(name: str) -> Callable[[DroneSetup], DroneNavigation]:
    """Return the navigation class that a fleet file names; raise `BadInput` if that fails."""
    return cast("Callable[[DroneSetup], DroneNavigation]", _loaded(NAVIGATION, name))


def load_localization(name: str) -> Callable[[Mapping[str, object]], Localization]:
    """Return the localization class that a fleet file names; not for `own`, which has none."""
    return cast("Callable[[Mapping[str, object]], Localization]", _loaded(LOCALIZATION, name))


def hears(name: str) -> bool:
    """Return whether a navigation accepts positions from outside; raise as loading does."""
    return hasattr(load_navigation(name), "locate")


def make_navigation(name: str, setup: DroneSetup) -> DroneNavigation:
    """Return the navigation of one drone; raise `BadInput` if there cannot be one."""
    canonical_uri(name, setup.id, setup.uri)
    return _made(NAVIGATION, name, load_navigation(name), setup, f" for {setup.id}")


def canonical_uri(name: str, drone: str, uri: str | None) -> str | None:
    """Return a drone's URI as its navigation writes it in full; as it is, if that does not say.

    Raises `BadInput` if it is none to that navigation.
    """
    by = load_navigation(name)
    if uri is None or not isinstance(by, Addressed):
        return uri
    try:
        return str(by.canonical_uri(uri))
    except ValueError as error:
        raise BadInput(f"{drone}: uri {quoted(uri)} {shortened(str(error))}") from error
    except ANY_ERROR as error:
        raise NAVIGATION.refused(name, f"cannot read a uri: {_said(error)}") from error


def make_localization(name: str, options: Mapping[str, object]) -> Localization:
    """Return the localization of a fleet; raise `BadInput` if there cannot be one."""
    return _made(LOCALIZATION, name, load_localization(name), options, "")


def _made(kind: PluginKind, name: str, of: Callable[[S], T], argument: S, whose: str) -> T:
    try:
        return of(argument)
    except KeyboardInterrupt:
        raise
    except ANY_ERROR as error:  # usually an invalid option
        raise kind.refused(name, f"could not be made{whose}: {_said(error)}") from error


@cache
def _loaded(kind: PluginKind, name: str) -> object:
    ours = dict(kind.ours)
    if name in ours:
        module, path = ours[name].split(":")
        return getattr(import_module(module, __package__), path)
    written = name if ":" in name else _offered(kind, name)
    module, path = _apart(kind, name, written)
    if written is name:
        with _only_what_is_installed():
            look_up(kind, name, module, path)
    found = _imported(kind, name, module, path)
    if not inspect.isclass(found):
        raise kind.refused(name, "is no class")
    wrong = problems(kind, found)
    if wrong:
        raise kind.refused(name, f"cannot be used: {'; '.join(wrong)}")
    return found


def _offered(kind: PluginKind, name: str) -> str:
    """Return the `module:Class` of an entry point."""
    from importlib.metadata import entry_points

    points = entry_points(group=kind.group)
    values = sorted({point.value for point in points if point.name == name})
    if not values:
        others = sorted({point.name for point in points} - set(dict(kind.ours)))
        raise plugins.no_such_name(kind, name, [*dict(kind.ours), *others])
    if len(values) > 1:
        raise BadInput(
            f"several installed packages offer a {kind.word} {quoted(name)}: "
            f"name the class itself, one of {', '.join(quoted(value) for value in values)}"
        )
    return values[0]


def _apart(kind: PluginKind, name: str, written: str) -> tuple[str, str]:
    module, _, path = (part.strip() for part in written.partition(":"))
    if not all(part.isidentifier() for part in [*module.split("."), *path.split(".")]):
        raise BadInput(
            f'{quoted(name)} names no {kind.word}: write module:Class, "my_drones:Parrot"'
        )
    return module, path


def _imported(kind: PluginKind, name: str, module: str, path: str) -> object:
    with _only_what_is_installed():
        try_import(kind, name, module)
    try:
        with _only_what_is_installed():
            found: object = import_module(module)
    except ModuleNotFoundError as error:
        missing = error.name or module
        if f"{module}.".startswith(f"{missing}."):
            raise plugins.no_such_module(kind, name, missing) from error
        raise plugins.needs(kind, name, missing) from error
    except KeyboardInterrupt:
        raise
    except ANY_ERROR as error:
        raise kind.refused(name, f"cannot be imported: {_said(error)}") from error
    for part in path.split("."):
        classes = [word for word, value in vars(found).items() if inspect.isclass(value)]
        found = getattr(found, part, None)
        if found is None:
            raise plugins.no_such_class(kind, name, part, classes)
    return found


@contextmanager
def _only_what_is_installed() -> Iterator[None]:
    """Keep modules in the current folder from being imported, as `python -m` would do.

    The gateway's process does the same, so both find the same modules.
    """
    first = sys.path[:1]
    here = not sys.flags.safe_path and any(os.path.isdir(one or ".") for one in first)
    here = here and os.path.samefile(first[0] or ".", ".")
    if here:
        del sys.path[0]
    try:
        yield
    finally:
        if here:
            sys.path[:0] = first


def _said(error: BaseException) -> str:
    said = str(error) if isinstance(error, BadInput) else f"{type(error).__name__}: {error}"
    return shortened(said)
