"""Free-form option tables, whose keys are interpreted by a drone's navigation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING

from ..shared.domain.text import quoted
from .reading import listed, near

if TYPE_CHECKING:
    from ..shared.domain.values import Table

Options = Mapping[str, object]
"""Texts, numbers, booleans, and lists and tables of these."""

DEEPEST = 8
"""The deepest nesting of tables and lists, which are sent to another process as JSON."""

_LARGEST_WHOLE = 2**63


def options_in(table: Table) -> Options:
    """Return a table's options; what JSON cannot hold is noted."""
    return table.read({}, dict.fromkeys(table.data, plain))


def navigation_options(top: Table, used: Sequence[str]) -> Mapping[str, Options]:
    """Return the tables `[navigation.NAME]` by name; one that no drone uses is noted."""
    every = top.table("navigation")
    for name in every.data:
        if name not in used:
            every.who = f"[navigation.{name}]"
            hint = near(name, used) or f"; in this fleet there is: {listed(used)}"
            every.problem(f"nothing is flown by a navigation {quoted(name)}{hint}", name)
    return {name: options_in(every.table(name)) for name in every.data if name in used}


def plain(value: object, depth: int = 1) -> object:
    """Read a value that JSON can hold without change."""
    if depth > DEEPEST:
        raise ValueError("is nested too deep")
    match value:
        case str() | bool():
            return value
        case int() if abs(value) < _LARGEST_WHOLE:
            return value
        case int():
            raise ValueError("is too large")
        case float() if isfinite(value):
            return value
        case float():
            raise ValueError("is not a finite number")
        case list():
            return [_inner(element, depth) for element in value]
        case dict():
            return {key: _inner(element, depth) for key, element in value.items()}
    raise ValueError("is a date or a time: put it in quotes")


def _inner(value: object, depth: int) -> object:
    try:
        return plain(value, depth + 1)
    except ValueError as wrong:
        said = f"{wrong}".removeprefix(_HAS)
        raise ValueError(said if said.endswith("too deep") else f"{_HAS}{said}") from None


_HAS = "has an element that "
