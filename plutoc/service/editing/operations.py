"""The gestures by which an app is changed, as values: what is meant, and nothing of how it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields
from types import MappingProxyType
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """An edge, by its two ends and its guard as written: no two of an app are the same."""

    source: str
    target: str
    when: tuple[str, ...] = ()
    otherwise: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class AddBlock:
    """Declare a block; without a name it gets a free one, made of its kind's.

    Where the kind needs a hook and none is given, the app's first one of that sort is taken, or a new
    one is declared.
    """

    kind: str
    """As an app writes it: `Clock`, `survey.GridScan`."""
    name: str = ""
    arguments: Mapping[str, str] = field(default_factory=dict)
    """Values as they are written: `{"default": "5 min"}`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoveBlocks:
    """Take blocks out, with all edges that touch them."""

    names: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Duplicate:
    """Copy blocks under new names, with the edges among them."""

    names: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Paste:
    """Put statements of Pluto text into the app; what they declare under a taken name is renamed."""

    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Connect:
    """Draw an edge."""

    arrow: Arrow


@dataclass(frozen=True, slots=True, kw_only=True)
class Disconnect:
    """Take an edge out."""

    arrow: Arrow


@dataclass(frozen=True, slots=True, kw_only=True)
class Redirect:
    """Lead an edge from or to another block; its guard stays."""

    arrow: Arrow
    source: str = ""
    target: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class SetGuard:
    """Give an edge another guard: statuses, `otherwise`, or none."""

    arrow: Arrow
    when: tuple[str, ...] = ()
    otherwise: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class SetArgument:
    """Give a parameter of a block or a category a value, or take it out: then its default counts."""

    owner: str
    parameter: str
    value: str | None
    """As it is written: `5 min`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SetTitle:
    """Give the app another title, or none."""

    title: str
    """What it says, without quotes; empty: none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Declare:
    """Add one declaration as it is written: a category, an action, an evaluator, …"""

    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Rewrite:
    """Put another text in the place of a declaration, or of a field: `mission.patient`."""

    name: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class RemoveDeclaration:
    """Take out a category, a field, an action, an evaluator, a modifier or a policy."""

    name: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Rename:
    """Give what is declared another name everywhere, in hooks.py too."""

    name: str
    new: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Bracket:
    """Write the unguarded edges from one block to several as one: `launch -> [watch, timer]`."""

    source: str
    targets: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Move:
    """Move a declaration, with the comments right above it, to before another one."""

    name: str
    before: str = ""
    """Empty: behind the last one."""


Operation = (
    AddBlock
    | RemoveBlocks
    | Duplicate
    | Paste
    | Connect
    | Disconnect
    | Redirect
    | SetGuard
    | SetArgument
    | SetTitle
    | Declare
    | Rewrite
    | RemoveDeclaration
    | Rename
    | Bracket
    | Move
)

KINDS: Mapping[str, type] = MappingProxyType({kind.__name__: kind for kind in Operation.__args__})


class NotAnOperation(Exception):
    """What came from outside is no operation. The message says why."""


def operation(data: object) -> Operation:
    """Return the operation that plain data means: `{"do": "Connect", "arrow": {…}}`."""
    if not isinstance(data, Mapping) or data.get("do") not in [*KINDS]:  # it may not be hashable
        raise NotAnOperation(f"`do` must be one of {', '.join(KINDS)}")
    made: Operation = _made(KINDS[data["do"]], {k: v for k, v in data.items() if k != "do"})
    return made


_EXPECTED = {
    "str": (str, "a text"),
    "str | None": (str | None, "a text or null"),
    "bool": (bool, "true or false"),
}


def _made(kind: type, data: Mapping[str, Any]) -> Any:
    known = {one.name: one for one in fields(kind)}
    for name in data.keys() - known.keys():
        raise NotAnOperation(f"{kind.__name__} has no field {name!r}")
    values: dict[str, object] = {}
    for name, one in known.items():
        if name in data:
            values[name] = _value(f"{name} of {kind.__name__}", str(one.type), data[name])
        elif one.default is MISSING and one.default_factory is MISSING:
            raise NotAnOperation(f"{kind.__name__} lacks {name!r}")
    return kind(**values)


def _value(what: str, wanted: str, given: object) -> object:
    if wanted == "Arrow":
        if not isinstance(given, Mapping):
            raise NotAnOperation(f"{what} must be an object")
        return _made(Arrow, given)
    if wanted == "tuple[str, ...]":
        if not isinstance(given, list) or not all(isinstance(each, str) for each in given):
            raise NotAnOperation(f"{what} must be a list of texts")
        return tuple(given)
    if wanted == "Mapping[str, str]":
        if not isinstance(given, Mapping) or not all(isinstance(v, str) for v in given.values()):
            raise NotAnOperation(f"{what} must be an object of texts")
        return MappingProxyType(dict(given))
    kind, words = _EXPECTED[wanted]
    if not isinstance(given, kind):
        raise NotAnOperation(f"{what} must be {words}")
    return given
