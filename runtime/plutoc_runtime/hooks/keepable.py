"""Results of hooks as plain data: a value that cannot be stored as such is stored as its text."""

from __future__ import annotations

from collections.abc import Iterable
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
        if type(value) not in _HARMLESS:
            _Measure().take(value)
    except ANY_ERROR as error:  # its own: a value may be an object of any kind
        unless_by_a_person(error)
        return shown(value)
    return value


def are_named(items: Iterable[tuple[Any, Any]]) -> bool:
    """Return whether these are values by name, with no name reserved by the journal."""
    return all(issubclass(type(name), str) and not str.startswith(name, "$") for name, _ in items)


class _Measure:
    """Measures the size and depth of a value without calling its methods."""

    def __init__(self) -> None:
        self._parts = self._characters = 0

    def take(self, value: Any, depth: int = 0) -> None:
        """Count a part and everything in it; raise an error beyond the limits."""
        self._parts += 1
        if depth > _DEEPEST or self._parts > _MOST:
            raise OverflowError
        kind = type(value)
        if value is None or issubclass(kind, (int, float)):
            return
        texts: tuple[str, ...] = ()
        if issubclass(kind, (list, tuple)):
            for part in (list if issubclass(kind, list) else tuple).__iter__(value):
                self.take(part, depth + 1)
        elif issubclass(kind, dict) and are_named(items := tuple(dict.items(value))):
            texts = tuple(name for name, _ in items)
            for _, part in items:
                self.take(part, depth + 1)
        elif isinstance(value, Photo) and kind is Photo:
            x, y, z = value.position
            _ = [float(number) for number in (x, y, z, value.width, value.height, value.sharpness)]
            texts = (*map(str, value.sees), str(value.file))
        else:
            texts = (value if issubclass(kind, str) else shown(value),)
        self._characters += sum(map(str.__len__, texts))
        if self._characters > _LONGEST:
            raise OverflowError
