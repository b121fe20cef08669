"""Results of hooks as plain data: a value that cannot be stored as such is stored as its text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

from ..domain.errors import ANY_ERROR
from ..domain.guard import unless_by_a_person
from ..domain.model import Photo
from ..domain.text import shown

_HARMLESS = (type(None), bool, float)

_DEEPEST, _MOST, _LONGEST = 50, 300_000, 10_000_000
"""Limits of one value: its depth, its number of parts, its characters."""


def keepable(value: object) -> object:
    """Return a hook's result, or its text if it is too large, too deep or circular."""
    try:
        return value if type(value) in _HARMLESS or _fits(value) else shown(value)
    except ANY_ERROR as error:  # its own: a value may be an object of any kind
        unless_by_a_person(error)
        return shown(value)


def are_named(items: Iterable[tuple[Any, Any]]) -> bool:
    """Return whether these are values by name, with no name reserved by the journal."""
    return all(issubclass(type(name), str) and not str.startswith(name, "$") for name, _ in items)


def _fits(value: Any) -> bool:
    """Return whether all parts of a value are within the limits; its methods are not called."""
    left, parts, characters = [(value, 0)], 0, 0
    while left:
        part, depth = left.pop()
        kind, texts = type(part), list[str]()
        inner: Iterator[Any] = iter(())
        if issubclass(kind, list):
            inner = list.__iter__(part)
        elif issubclass(kind, tuple):
            inner = tuple.__iter__(part)
        elif issubclass(kind, dict) and are_named(items := tuple(dict.items(part))):
            texts, inner = [name for name, _ in items], (one for _, one in items)
        elif kind is Photo:
            x, y, z = part.position
            _ = [float(one) for one in (x, y, z, part.width, part.height, part.sharpness)]
            texts = [*map(str, part.sees), str(part.file)]
        elif part is not None and not issubclass(kind, (int, float)):
            texts = [part if issubclass(kind, str) else shown(part)]
        left += [(one, depth + 1) for one in islice(inner, _MOST)]
        parts += 1
        characters += sum(map(str.__len__, texts))
        if depth > _DEEPEST or parts > _MOST or characters > _LONGEST:
            return False
    return True
