"""What a class must have, to be a navigation or a localization: as data, checked by `checking.py`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Shape(Enum):
    """How a method is called."""

    WAITS = "async def"
    AT_ONCE = "def"
    ITERATES = "an async generator"
    PROPERTY = "a property"


@dataclass(frozen=True, slots=True)
class Method:
    """A method that the runtime calls, by place and never by name."""

    name: str
    shape: Shape = Shape.WAITS
    takes: tuple[str, ...] = ()
    of_class: bool = False
    """Whether it is called without a drone: of the class."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """Something that a fleet file names, and a package may offer."""

    word: str
    group: str
    """Of entry points."""
    argument: str
    """What the class is called with."""
    such_as: str
    """One that somebody could write."""
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
    Method("telemetry", Shape.PROPERTY),
    Method("events", Shape.ITERATES),
)
CAPABILITIES = (
    (
        Method("why_not", Shape.AT_ONCE, ("action", "parameters")),
        Method("act", takes=("action", "parameters", "item")),
    ),
    (Method("read", takes=("name",)), Method("write", takes=("name", "value"))),
    (Method("locate", takes=("position",)),),
    (Method("looked_after"),),
    (Method("identify"),),
    (Method("scan", takes=("options",), of_class=True),),
)
LOCALIZATION_METHODS = (Method("positions", Shape.ITERATES),)
