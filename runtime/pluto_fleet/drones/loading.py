"""Loading the navigation, localization or tracker class that a fleet file names; nothing of it is called.

A name is a built-in one (`crazyflie`), an entry point of an installed package, or `module:Class`. Only
installed modules are found: a fleet file is data, and its folder is no place for code. A module is
imported only if its text has the name of the class, so that a fleet file from elsewhere cannot have just
any module run.
"""

from __future__ import annotations

import inspect
import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from importlib.machinery import ModuleSpec
from typing import TypeVar, cast

from ..files.reading import near
from ..shared.domain.errors import ANY_ERROR, BadInput
from ..shared.domain.text import quoted
from .localization import Localization
from .protocol import (
    Acts,
    ActsOnTheWay,
    Addressed,
    CaredFor,
    DroneNavigation,
    DroneSetup,
    Follows,
    Identifiable,
    Locatable,
    Readable,
    Scannable,
    Sees,
)
from .timeouts import shortened
from .tracking import Tracker

S = TypeVar("S")
T = TypeVar("T")


@dataclass(frozen=True, eq=False, kw_only=True)
class PluginKind:
    """A kind of plugin, which a fleet file names and a package may offer."""

    word: str
    group: str
    """The group of its entry points."""
    argument: str
    """The argument of the class."""
    such_as: str
    """An example of a name."""
    methods: type
    """The protocol of what a class must have."""
    abilities: tuple[type, ...] = ()
    """Protocols of which a class has all methods, or none."""
    of_class: tuple[type, ...] = ()
    """Such that are static methods."""
    ours: Mapping[str, str]
    """The built-in ones, which no package can replace: their relative `module:Class`."""

    def refused(self, name: str, why: str) -> BadInput:
        """Return the error about one of this kind."""
        return BadInput(f"the {self.word} {quoted(name)} {why}")

    def no_such_name(self, name: str, names: Sequence[str]) -> BadInput:
        """Return the error about a name that is not offered; `names`: those that are."""
        hint = near(name, names)
        there = f"there is: {', '.join(names)}; or write" if names else "write"
        return BadInput(
            f"no {self.word} {quoted(name)} is installed{hint}{' ' if hint else '; '}{there}"
            f' module:Class, such as "{self.such_as}"'
        )

    def no_such_module(self, name: str, module: str) -> BadInput:
        """Return the error about a module that is not installed."""
        return self.refused(
            name,
            f"is in no module that is installed: there is no {quoted(module)};"
            " install its package with pip, or put its folder into PYTHONPATH",
        )

    def no_such_class(self, name: str, wanted: str, there: Sequence[str]) -> BadInput:
        """Return the error about a class that its module does not have; `there`: those that it has."""
        hint = near(wanted, there)
        return BadInput(
            f"the {self.word} {quoted(name)}: its module has no class {quoted(wanted)}{hint}"
        )


NAVIGATION = PluginKind(
    word="navigation",
    ours={
        "crazyflie": "..crazyflie.navigation:Crazyflie",
        "mavlink": "..mavlink.navigation:MavlinkVehicle",
    },
    group="plutoc.navigations",
    argument="setup",
    such_as="my_drones.parrot:Parrot",
    methods=DroneNavigation,
    abilities=(
        Acts,
        ActsOnTheWay,
        Follows,
        Sees,
        Readable,
        Locatable,
        CaredFor,
        Identifiable,
    ),
    of_class=(Scannable, Addressed),
)
LOCALIZATION = PluginKind(
    word="localization",
    ours={},
    group="plutoc.localizations",
    argument="options",
    such_as="my_cameras:Ceiling",
    methods=Localization,
)
TRACKER = PluginKind(
    word="tracker",
    ours={"lines": ".lines:Lines"},
    group="plutoc.trackers",
    argument="options",
    such_as="my_cameras:Walkers",
    methods=Tracker,
)


def load_navigation(name: str) -> Callable[[DroneSetup], DroneNavigation]:
    """Return the navigation class that a fleet file names; raise `BadInput` if that fails."""
    return cast("Callable[[DroneSetup], DroneNavigation]", _loaded(NAVIGATION, name))


def load_localization(name: str) -> Callable[[Mapping[str, object]], Localization]:
    """Return the localization class that a fleet file names; not for `own`, which has none."""
    return cast("Callable[[Mapping[str, object]], Localization]", _loaded(LOCALIZATION, name))


def load_tracker(name: str) -> Callable[[Mapping[str, object]], Tracker]:
    """Return the tracker class that a fleet file names; raise `BadInput` if that fails."""
    return cast("Callable[[Mapping[str, object]], Tracker]", _loaded(TRACKER, name))


def hears(name: str) -> bool:
    """Return whether a navigation accepts positions from outside; raise as loading does."""
    return hasattr(load_navigation(name), "locate")


def deaf(localization: str, drones: Sequence[str]) -> BadInput:
    """Return the error about drones that do not accept positions from a localization."""
    return BadInput(
        f"localization {localization}: {', '.join(drones)} cannot be told where they are; "
        "their navigation has no method locate"
    )


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


def make_tracker(name: str, options: Mapping[str, object]) -> Tracker:
    """Return the tracker of a fleet; raise `BadInput` if there cannot be one."""
    return _made(TRACKER, name, load_tracker(name), options, "")


def _made(kind: PluginKind, name: str, of: Callable[[S], T], argument: S, whose: str) -> T:
    try:
        return of(argument)
    except KeyboardInterrupt:
        raise
    except ANY_ERROR as error:  # usually an invalid option
        raise kind.refused(name, f"could not be made{whose}: {_said(error)}") from error


@cache
def _loaded(kind: PluginKind, name: str) -> object:
    if name in kind.ours:
        module, path = kind.ours[name].split(":")
        return getattr(import_module(module, __package__), path)
    module, path = _apart(kind, name, name if ":" in name else _offered(kind, name))
    with _only_what_is_installed():
        if ":" in name:
            _look_up(kind, name, module, path)
        found = _imported(kind, name, module)
    for part in path.split("."):
        classes = [word for word, value in vars(found).items() if inspect.isclass(value)]
        found = getattr(found, part, None)
        if found is None:
            raise kind.no_such_class(name, part, classes)
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
        raise kind.no_such_name(name, [*kind.ours, *sorted({*points.names} - {*kind.ours})])
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


def _look_up(kind: PluginKind, name: str, module: str, path: str) -> None:
    """Raise `BadInput` if there is no such module, or if its text does not have the name of the class."""
    if module in sys.modules:
        return
    parts = module.split(".")
    if parts[0] in sys.stdlib_module_names:
        raise kind.refused(name, f"is none: {quoted(module)} is a module of Python's own")
    spec: ModuleSpec | None = getattr(sys.modules.get(parts[0]), "__spec__", None)
    for count in range(1 if spec is None else 2, len(parts) + 1):
        above = None if spec is None else spec.submodule_search_locations or []
        spec = _found(".".join(parts[:count]), above)
        if spec is None:
            raise kind.no_such_module(name, ".".join(parts[:count]))
    assert spec is not None
    wanted = path.partition(".")[0]
    text = _text(kind, name, spec)
    is_module = _found(f"{module}.{wanted}", spec.submodule_search_locations or [])
    if not is_module and not re.search(rf"\b{wanted}\b|import \*", text):
        raise kind.no_such_class(name, wanted, re.findall(r"^class (\w+)", text, re.MULTILINE))


def _found(module: str, where: Sequence[str] | None) -> ModuleSpec | None:
    """Return a module's spec, without importing what it is in."""
    specs = (finder.find_spec(module, where) for finder in sys.meta_path)
    return next(filter(None, specs), None)


def _text(kind: PluginKind, name: str, spec: ModuleSpec) -> str:
    read = getattr(spec.loader, "get_source", None)
    text: str | None = None if read is None else read(spec.name)
    if text is None:
        raise kind.refused(
            name,
            f"cannot be looked up: {quoted(spec.name)} has no text in Python; its package can offer"
            f" the class by an entry point, {kind.group}",
        )
    return text


def _imported(kind: PluginKind, name: str, module: str) -> object:
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        missing = error.name or module
        if f"{module}.".startswith(f"{missing}."):
            raise kind.no_such_module(name, missing) from error
        raise kind.refused(name, f"needs {quoted(missing)}: install it with pip") from error
    except KeyboardInterrupt:
        raise
    except ANY_ERROR as error:
        raise kind.refused(name, f"cannot be imported: {_said(error)}") from error


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


# What a class must have; types are left to mypy


def problems(kind: PluginKind, made: type) -> list[str]:
    """Return all that is wrong with a class of this kind."""
    found: list[str] = []
    if not _takes(made, [kind.argument]):
        found.append(f"it cannot be made: its __init__ must take ({kind.argument})")
    for name in _methods(kind.methods):
        found += _of_method(made, kind.methods, name)
    for protocol in (*kind.abilities, *kind.of_class):
        names = _methods(protocol)
        there = [name for name in names if hasattr(made, name)]
        for name in names if there else ():
            if name not in there:
                found.append(f"it has {there[0]} but no {name}: both belong together")
            elif protocol in kind.of_class and not _stands_alone(made, name):
                found.append(
                    f"its {name} must be a staticmethod: it is called before there is a drone"
                )
            else:
                found += _of_method(made, protocol, name)
    return found


def _methods(protocol: type) -> list[str]:
    return [name for name in vars(protocol) if not name.startswith("_")]


def _of_method(made: type, protocol: type, name: str) -> Iterator[str]:
    wanted = getattr(protocol, name)
    attribute = getattr(made, name, None)
    if isinstance(wanted, property):
        if inspect.isroutine(attribute):  # a missing one may be set by `__init__`
            yield f"its {name} must be a property: put @property above it"
        return
    if attribute is None:
        yield f"it has no method {name}"
        return
    if not callable(attribute):
        yield f"its {name} is no method"
        return
    written = inspect.unwrap(attribute)
    waits = inspect.iscoroutinefunction(written)
    signature = inspect.signature(wanted)
    arguments = list(signature.parameters)[1:]
    if "AsyncIterator" in str(signature.return_annotation):
        if waits:
            yield f"its {name} must be an async generator, or `def` and return an async iterator"
            return
    elif inspect.iscoroutinefunction(wanted):
        if not waits:
            yield f"its {name} must be `async def`"
            return
    elif waits or inspect.isasyncgenfunction(written):
        yield f"its {name} must be `def`, not `async def`"
        return
    if not _takes(attribute, [*([] if _stands_alone(made, name) else ["self"]), *arguments]):
        takes = f"({', '.join(arguments)})" if arguments else "nothing"
        yield f"its {name} cannot be called so: it takes {takes}"


def _stands_alone(made: type, name: str) -> bool:
    """Return whether a method needs no object."""
    return isinstance(inspect.getattr_static(made, name), (staticmethod, classmethod))


def _takes(called: Callable[..., object], arguments: list[str]) -> bool:
    """Return whether something can be called with this many arguments; unknown counts as yes."""
    try:
        signature = inspect.signature(called)
    except (TypeError, ValueError):  # not written in Python
        return True
    try:
        signature.bind(*arguments)
    except TypeError:
        return False
    return True
