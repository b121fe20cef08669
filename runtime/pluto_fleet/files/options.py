"""Free-form option tables, whose keys are interpreted by a drone's navigation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import date, time
from math import isfinite
from typing import TYPE_CHECKING, cast

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


def plain(value: object) -> object:
    """Return a value, if JSON can hold it without change."""
    for part, depth in _parts(value, 1):
        if depth > DEEPEST:
            raise ValueError("is nested too deep")
        if said := _no_json(part):
            raise ValueError(said if part is value else f"has an element that {said}")
    return value


def _parts(value: object, depth: int) -> Iterator[tuple[object, int]]:
    yield value, depth
    inner = value.values() if isinstance(value, dict) else value
    if isinstance(value, dict | list) and depth <= DEEPEST:
        for part in cast("Iterable[object]", inner):
            yield from _parts(part, depth + 1)


def _no_json(value: object) -> str:
    if isinstance(value, date | time):
        return "is a date or a time: put it in quotes"
    if isinstance(value, float) and not isfinite(value):
        return "is not a finite number"
    return "is too large" if isinstance(value, int) and abs(value) >= _LARGEST_WHOLE else ""
