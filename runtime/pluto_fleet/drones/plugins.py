"""What a fleet file may name, navigations and localizations: their methods as data, and what is
said of a class that cannot be used.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import duration, quoted


class CallStyle(Enum):
    """How a method is called."""

    WAITS = "async def"
    AT_ONCE = "def"
    ITERATES = "an async generator"
    PROPERTY = "a property"


@dataclass(frozen=True, slots=True)
class Method:
    """A method that the runtime calls, by place and never by name."""

    name: str
    shape: CallStyle = CallStyle.WAITS
    takes: tuple[str, ...] = ()
    of_class: bool = False
    """Whether it is called without a drone: of the class."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PluginKind:
    """Something that a fleet file names, and a package may offer."""

    word: str
    group: str
    """Of entry points."""
    argument: str
    """What the class is called with."""
    such_as: str
    """An example of a name."""
    methods: tuple[Method, ...]
    together: tuple[tuple[Method, ...], ...] = ()
    """What only some have: all of such a group, or none of it."""
    ours: tuple[tuple[str, str], ...] = ()
    """Those of this library: each name and its `module:Class`, seen from here; no package replaces them."""


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
)
LOCALIZATION_METHODS = (Method("positions", CallStyle.ITERATES),)


def no_such_name(kind: PluginKind, name: str, names: Sequence[str]) -> BadInput:
    found = get_close_matches(name, names, n=1, cutoff=0.6)
    hint = f"did you mean {quoted(found[0])}? " if found else ""
    there = f"there is: {', '.join(names)}; or write" if names else "write"
    return BadInput(
        f"no {kind.word} {quoted(name)} is installed; {hint}{there} module:Class, "
        f'such as "{kind.such_as}"'
    )


def several(kind: PluginKind, name: str, values: Sequence[str]) -> BadInput:
    return BadInput(
        f"several installed packages offer a {kind.word} {quoted(name)}: "
        f"name the class itself, one of {', '.join(quoted(value) for value in values)}"
    )


def no_class_written(kind: PluginKind, name: str) -> BadInput:
    return BadInput(f'{quoted(name)} names no {kind.word}: write module:Class, "my_drones:Parrot"')


def no_such_module(kind: PluginKind, name: str, module: str) -> BadInput:
    return BadInput(
        f"the {kind.word} {quoted(name)} is in no module that is installed: there is no "
        f"{quoted(module)}; install its package with pip, or put its folder into PYTHONPATH"
    )


def of_python(kind: PluginKind, name: str, module: str) -> BadInput:
    return BadInput(
        f"the {kind.word} {quoted(name)} is none: {quoted(module)} is a module of Python's own"
    )


def no_text(kind: PluginKind, name: str, module: str) -> BadInput:
    return BadInput(
        f"the {kind.word} {quoted(name)} cannot be looked up: {quoted(module)} has no text in"
        f" Python; its package can offer the class by an entry point, {kind.group}"
    )


def needs(kind: PluginKind, name: str, missing: str) -> BadInput:
    return BadInput(f"the {kind.word} {quoted(name)} needs {quoted(missing)}: install it with pip")


def not_imported(kind: PluginKind, name: str, why: str) -> BadInput:
    return BadInput(f"the {kind.word} {quoted(name)} cannot be imported: {why}")


def hangs(kind: PluginKind, name: str, module: str, seconds: float, said: str) -> BadInput:
    last = f"; the last it said: {said}" if said else ""
    return BadInput(
        f"the {kind.word} {quoted(name)} cannot be imported: {quoted(module)} was not done with"
        f" that in {duration(seconds)}{last}"
    )


def ends_all(kind: PluginKind, name: str, module: str, how: str, said: str) -> BadInput:
    last = f"; the last it said: {said}" if said else ""
    return BadInput(
        f"the {kind.word} {quoted(name)} cannot be imported: {quoted(module)} ends the process"
        f" that imports it ({how}){last}"
    )


def no_such_class(kind: PluginKind, name: str, wanted: str, there: Sequence[str]) -> BadInput:
    found = get_close_matches(wanted, there, n=1, cutoff=0.6)
    hint = f"; did you mean {quoted(found[0])}?" if found else ""
    return BadInput(
        f"the {kind.word} {quoted(name)}: its module has no class {quoted(wanted)}{hint}"
    )


def not_a_class(kind: PluginKind, name: str) -> BadInput:
    return BadInput(f"the {kind.word} {quoted(name)} is no class")


def lacks(kind: PluginKind, name: str, problems: Sequence[str]) -> BadInput:
    return BadInput(f"the {kind.word} {quoted(name)} cannot be used: {'; '.join(problems)}")


def not_made(kind: PluginKind, name: str, whose: str, why: str) -> BadInput:
    return BadInput(f"the {kind.word} {quoted(name)} could not be made{whose}: {why}")


def deaf(localization: str, drones: Sequence[str]) -> BadInput:
    return BadInput(
        f"localization {localization}: {', '.join(drones)} cannot be told where they are; "
        "their navigation has no method locate"
    )


# What is wrong with a class


def no_method(method: str) -> str:
    return f"it has no method {method}"


def not_callable(method: str) -> str:
    return f"its {method} is no method"


def not_async(method: str) -> str:
    return f"its {method} must be `async def`"


def is_async(method: str) -> str:
    return f"its {method} must be `def`, not `async def`"


def no_iterator(method: str) -> str:
    return f"its {method} must be an async generator, or `def` and return an async iterator"


def not_taken(method: str, arguments: Sequence[str]) -> str:
    takes = f"takes ({', '.join(arguments)})" if arguments else "takes nothing"
    return f"its {method} cannot be called so: it {takes}"


def not_static(method: str) -> str:
    return f"its {method} must be a staticmethod: it is called before there is a drone"


def no_property() -> str:
    return "its telemetry must be a property: put @property above it"


def half(method: str, beside: str) -> str:
    return f"it has {beside} but no {method}: both belong together"


def not_made_of(argument: str) -> str:
    return f"it cannot be made: its __init__ must take ({argument})"
