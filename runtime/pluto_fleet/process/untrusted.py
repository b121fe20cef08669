"""Reading JSON that anyone may have written: it is bounded, and held to a type before it is used."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import is_dataclass
from enum import Enum
from functools import cache
from math import isfinite
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

DEEPEST = 64
"""How deep lists and objects may lie in each other: a hook's result has 50 at most."""

MOST_PARTS = 8_000_000
"""The most elements and containers, so that no text takes many times its size in memory."""

LARGEST = 1e15
"""The largest absolute number where one is counted with."""

LARGEST_WHOLE = 2**63
"""A whole number is smaller: times in nanoseconds are."""

LATEST = 1e9
"""The largest time, in seconds since a beginning."""

_MOST_DIGITS = 300
"""Digits of a whole number that is still a finite one."""


def parsed(given: str | bytes) -> Any:
    """Return the data; raise `ValueError` with what is wrong. A number that is none becomes null."""
    text = given if isinstance(given, str) else given.decode()
    if len(text) > MOST_PARTS and sum(map(text.count, "[{,")) > MOST_PARTS:
        raise ValueError(f"it has more than {MOST_PARTS} parts")
    try:
        data = _JSON.decode(text)
    except RecursionError:
        raise ValueError(_TOO_DEEP) from None
    if text.count("[") + text.count("{") > DEEPEST:
        _bound_depth(data)
    if _ESCAPED in text:
        # half a character is no text, and a result or a reason may hold one: it is shown as `?`
        whole = json.dumps(data, ensure_ascii=False).encode(errors="replace")
        data = _JSON.decode(whole.decode())
    return data


_ESCAPED = "\\u"


def _finite(text: str) -> float | None:
    number = float(text)
    return number if isfinite(number) else None


def _whole(text: str) -> int | None:
    return int(text) if len(text) <= _MOST_DIGITS else None


_JSON = json.JSONDecoder(parse_float=_finite, parse_int=_whole, parse_constant=lambda _: None)

_TOO_DEEP = f"it is nested deeper than {DEEPEST}"


def _bound_depth(data: object) -> None:
    level = [data]
    for _ in range(DEEPEST + 1):
        containers = [one for one in level if isinstance(one, (list, dict))]
        level = [inner for one in containers for inner in _inside(one)]
        if not level:
            return
    raise ValueError(_TOO_DEEP)


def _inside(one: list[Any] | dict[str, Any]) -> list[Any]:
    return one if isinstance(one, list) else list(one.values())


Test = Callable[[object], bool]


@cache
def fits(hint: Any) -> Test:
    """Return the test whether plain data is of a type.

    A `float` may be a whole number, and both are of bounded size; `tuple[float, float]` is a list of
    two, of an enum it is the text of a member; an object of a `TypedDict` or a dataclass may
    have more keys.
    """
    if hint is Any:
        return lambda value: True
    if is_typeddict(hint) or is_dataclass(hint):
        return _object(hint)
    if isinstance(hint, type) and issubclass(hint, Enum):
        names = {one.value for one in hint}
        return lambda value: type(value) is str and value in names
    kinds = get_args(hint)
    match get_origin(hint):
        case None:
            return _PLAIN[hint]
        case origin if origin in (Union, UnionType):
            tests = [fits(kind) for kind in kinds]
            return lambda value: any(test(value) for test in tests)
        case origin if origin is Literal:
            return lambda value: type(value) is str and value in kinds
        case origin if origin is NotRequired:
            return fits(kinds[0])
        case origin if origin is dict:
            inner = fits(kinds[1])
            return lambda value: type(value) is dict and all(map(inner, value.values()))
        case origin if origin is tuple:
            each = [fits(kind) for kind in kinds]
            return lambda value: (
                type(value) is list
                and len(value) == len(each)
                and all(test(one) for test, one in zip(each, value, strict=True))
            )
        case _:
            inner = fits(kinds[0])
            return lambda value: type(value) is list and all(map(inner, value))


@cache
def fields_of(hint: Any) -> dict[str, Test]:
    """Return the test of each key of a `TypedDict` or a dataclass."""
    return {name: fits(kind) for name, kind in get_type_hints(hint, include_extras=True).items()}


def _object(hint: Any) -> Test:
    kinds = get_type_hints(hint, include_extras=True).items()
    needed = {name for name, kind in kinds if get_origin(kind) is not NotRequired}
    tests = fields_of(hint)

    def test(value: object) -> bool:
        return (
            type(value) is dict
            and needed <= value.keys()
            and all(tests[name](one) for name, one in value.items() if name in tests)
        )

    return test


_PLAIN: dict[Any, Test] = {
    str: lambda value: type(value) is str,
    bool: lambda value: type(value) is bool,
    int: lambda value: type(value) is int and abs(value) < LARGEST_WHOLE,
    float: lambda value: isinstance(value, (int, float))
    and type(value) is not bool
    and abs(value) <= LARGEST,
    NoneType: lambda value: value is None,
    None: lambda value: value is None,
    object: lambda value: True,
}
