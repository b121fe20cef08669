"""Free-form option tables, whose keys are interpreted by a drone's navigation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import TYPE_CHECKING

from . import errors

if TYPE_CHECKING:
    from .reading import Table

Options = Mapping[str, object]
"""Texts, numbers, booleans, and lists and tables of these."""

DEEPEST = 8
"""The deepest nesting of tables and lists, which are sent to another process as JSON."""

_LARGEST_WHOLE = 2**63


def options_under(around: Table, key: str, header: str = "") -> Options:
    """Return the options under a key; empty if there are none."""
    table = around.table(key, header)
    return {} if table is None else options_in(table)


def options_in(table: Table) -> Options:
    """Return a table's options; values that JSON cannot hold are reported."""
    found: dict[str, object] = {}
    for key in table.data:
        value = table.read(key, plain)
        if value is not None:
            found[key] = value
    return found


def navigation_options(top: Table, used: Sequence[str]) -> Mapping[str, Options]:
    """Return the tables `[navigation.NAME]` by name; one that no drone uses is reported."""
    every = top.table("navigation")
    if every is None:
        return {}
    found: dict[str, Options] = {}
    for name in every.data:
        every.who = f"[navigation.{name}]"
        if name not in used:
            every.problem(errors.navigation_unused(name, used), name)
        else:
            found[name] = options_under(every, name, f"navigation.{name}")
    return found


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
        case _:
            raise ValueError("is a date or a time: put it in quotes")


def _inner(value: object, depth: int) -> object:
    try:
        return plain(value, depth + 1)
    except ValueError as wrong:
        words = str(wrong)
        if words.startswith(_HAS) or words.endswith("too deep"):
            raise
        raise ValueError(f"{_HAS}{words}") from None


_HAS = "has an element that "
