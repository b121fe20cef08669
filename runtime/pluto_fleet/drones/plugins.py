"""The plugins of a fleet file, navigations and localizations: their methods as data, and the messages
for a class that cannot be used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum

from ..files.reading import near
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted


class CallStyle(Enum):
    """How a method is called."""

    WAITS = "async def"
    AT_ONCE = "def"
    ITERATES = "an async generator"
    PROPERTY = "a property"


@dataclass(frozen=True, slots=True)
class Method:
    """A method that the runtime calls, with positional arguments."""

    name: str
    shape: CallStyle = CallStyle.WAITS
    takes: tuple[str, ...] = ()
    of_class: bool = False
    """Whether it is a static method."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PluginKind:
    """A kind of plugin, which a fleet file names and a package may offer."""

    word: str
    group: str
    """The group of its entry points."""
    argument: str
    """The argument of the class."""
    such_as: str
    """An example of a name."""
    methods: tuple[Method, ...]
    together: tuple[tuple[Method, ...], ...] = ()
    """Optional groups of methods: a class has all of a group, or none."""
    ours: tuple[tuple[str, str], ...] = ()
    """The built-in ones: each name and its relative `module:Class`; no package can replace them."""

    def refused(self, name: str, why: str) -> BadInput:
        """Return the error about one of this kind."""
        return BadInput(f"the {self.word} {quoted(name)} {why}")


NAVIGATION_METHODS = (
    Method("connect"),
    Method("preflight"),
    Method("takeoff", takes=("height", "speed")),
    Method("go_to", takes=("target", "speed")),
    Method("hold"),
    Method("land", takes=("speed",)),
    Method("emergency_stop"),
    Method("close"),
    Method("telemetry", CallStyle.PROPERTY),
    Method("events", CallStyle.ITERATES),
)
CAPABILITIES = (
    (
        Method("why_not", CallStyle.AT_ONCE, ("action", "parameters")),
        Method("act", takes=("action", "parameters", "item")),
    ),
    (Method("read", takes=("name",)), Method("write", takes=("name", "value"))),
    (Method("locate", takes=("position",)),),
    (Method("looked_after"),),
    (Method("identify"),),
    (Method("scan", takes=("options",), of_class=True),),
    (Method("canonical_uri", CallStyle.AT_ONCE, ("uri",), of_class=True),),
)
LOCALIZATION_METHODS = (Method("positions", CallStyle.ITERATES),)


def no_such_name(kind: PluginKind, name: str, names: Sequence[str]) -> BadInput:
    """Return the error about a name that is not offered; `names`: those that are."""
    found = get_close_matches(name, names, n=1, cutoff=0.6)
    hint = f"did you mean {quoted(found[0])}? " if found else ""
    there = f"there is: {', '.join(names)}; or write" if names else "write"
    return BadInput(
        f"no {kind.word} {quoted(name)} is installed; {hint}{there} module:Class, "
        f'such as "{kind.such_as}"'
    )


def no_such_module(kind: PluginKind, name: str, module: str) -> BadInput:
    """Return the error about a module that is not installed."""
    return kind.refused(
        name,
        f"is in no module that is installed: there is no {quoted(module)};"
        " install its package with pip, or put its folder into PYTHONPATH",
    )


def needs(kind: PluginKind, name: str, missing: str) -> BadInput:
    """Return the error about a module that the class needs."""
    return kind.refused(name, f"needs {quoted(missing)}: install it with pip")


def no_such_class(kind: PluginKind, name: str, wanted: str, there: Sequence[str]) -> BadInput:
    """Return the error about a class that its module does not have; `there`: those that it has."""
    hint = near(wanted, there)
    return BadInput(
        f"the {kind.word} {quoted(name)}: its module has no class {quoted(wanted)}{hint}"
    )


def deaf(localization: str, drones: Sequence[str]) -> BadInput:
    """Return the error about drones that do not accept positions from a localization."""
    return BadInput(
        f"localization {localization}: {', '.join(drones)} cannot be told where they are; "
        "their navigation has no method locate"
    )
