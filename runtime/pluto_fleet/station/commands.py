"""The commands of a station, and the check of their arguments against their types."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import NoneType, UnionType
from typing import (
    Any,
    Literal,
    NotRequired,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from .requests import COMMANDS

LARGEST = 1_000_000_000
"""The largest absolute priority, as in a missions file."""


class Malformed(BadInput):
    """A malformed command: it lacks an argument, for example."""


def checked(name: str, given: Mapping[str, object]) -> dict[str, object]:
    """Return a command's arguments; raise `Malformed` if one is missing or invalid."""
    if name not in COMMANDS:
        raise Malformed(f"there is no command {quoted(name)}")
    needs = _arguments(name)
    for key in given:
        if key not in needs:
            raise Malformed(f"{name} takes no {quoted(key)}")
    arguments: dict[str, object] = {}
    for key, kinds in needs.items():
        value = given.get(key)
        if not any(_fits(value, kind) for kind in kinds):
            raise Malformed(f"{name} needs {key}: {' or '.join(map(_said, kinds))}")
        arguments[key] = value
    priority = arguments.get("priority")
    if isinstance(priority, int) and abs(priority) > LARGEST:
        raise Malformed(f"a priority is no more than {LARGEST}")
    return arguments


@cache
def _arguments(name: str) -> Mapping[str, tuple[Any, ...]]:
    """Return the types that each argument of a command may have."""
    hints = get_type_hints(COMMANDS[name], include_extras=True)
    return {key: _kinds(hint) for key, hint in hints.items() if key != "id"}


def _kinds(hint: Any) -> tuple[Any, ...]:
    if get_origin(hint) is NotRequired:
        hint = get_args(hint)[0]
    return get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)


def _fits(value: object, kind: Any) -> bool:
    if is_typeddict(kind):
        return isinstance(value, dict)  # its keys are checked by what takes it
    if kind is float:
        return type(value) in (int, float)
    match get_origin(kind):
        case None:
            return type(value) is kind
        case origin if origin is Literal:
            return type(value) is str and value in get_args(kind)
        case origin if origin is dict:
            return isinstance(value, dict)
        case _:  # a list
            [inner] = get_args(kind)
            return isinstance(value, list) and all(_fits(one, inner) for one in value)


def _said(kind: Any) -> str:
    match get_origin(kind):
        case None:
            return "an object" if is_typeddict(kind) else _NAMES[kind]
        case origin if origin is Literal:
            return " or ".join(f'"{one}"' for one in get_args(kind))
        case origin if origin is dict:
            return "an object"
        case _:
            [inner] = get_args(kind)
            return f"a list, each of it {_said(inner)}"


_NAMES = {
    str: "a text",
    bool: "true or false",
    int: "a whole number",
    float: "a number",
    NoneType: "null",
}
