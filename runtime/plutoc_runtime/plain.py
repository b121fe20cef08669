"""What a hook or an action gave, as plain data: what is kept of it, whatever it may be."""

from __future__ import annotations

from math import isfinite, log10
from typing import Any, cast

from .guard import by_a_person
from .kernel import WHATEVER
from .model import Photo
from .words import MOST_DIGITS, shown

Data = dict[str, Any]
"""Plain data, as JSON can hold it."""


def value_data(value: object) -> object:
    """Return what an action gave as plain data; what is no plain data is kept as text.

    A photo, and what is not plain, becomes an object with one key that no result of plain data is
    mistaken for. What is too large, too deep or goes round in a circle is text as a whole.
    """
    try:
        return _Keeping().data(value)
    except WHATEVER as error:  # its own: a value may be an object of any kind
        if by_a_person(error):
            raise
        return {"$text": shown(value)}


def keepable(value: object) -> object:
    """Return what a hook gave as the runtime takes it in: itself, or its text if it cannot be kept."""
    try:
        if type(value) not in _HARMLESS:
            _Keeping().data(value)
    except WHATEVER as error:
        if by_a_person(error):
            raise
        return shown(value)
    return value


_HARMLESS = (type(None), bool, float)

_DEEPEST, _MOST, _LONGEST = 50, 300_000, 10_000_000
"""Of one value: how deep lists may lie in lists, how many parts it has, how many characters."""


class _TooMuch(Exception):
    """It cannot be kept as plain data."""


class _Keeping:
    """One value on its way into the journal."""

    def __init__(self) -> None:
        self._parts, self._characters = 0, 0

    def data(self, value: object, depth: int = 0) -> object:
        """Return it as plain data; its class may be any, and is asked nothing."""
        self._parts += 1
        if depth > _DEEPEST or self._parts > _MOST:
            raise _TooMuch
        kind = type(value)
        if value is None or kind is bool:
            return value
        if issubclass(kind, int):
            number = int.__pos__(cast("int", value))
            return {"$text": shown(number)} if number.bit_length() > _BITS else number
        if issubclass(kind, float):
            real = float.__pos__(cast("float", value))
            return real if isfinite(real) else {"$number": repr(real)}
        if issubclass(kind, str):
            return self._text(cast("str", value))
        if issubclass(kind, list):
            return [self.data(part, depth + 1) for part in list.__iter__(cast("Any", value))]
        if issubclass(kind, tuple):
            parts = tuple.__iter__(cast("Any", value))
            return {"$tuple": [self.data(part, depth + 1) for part in parts]}
        if issubclass(kind, dict):
            return self._object(cast("dict[object, object]", value), depth)
        if isinstance(value, Photo) and kind is Photo:
            return _photo_data(value)
        return {"$text": self._text(shown(value))}

    def _text(self, value: str) -> str:
        text = str.__str__(value)
        self._characters += len(text)
        if self._characters > _LONGEST:
            raise _TooMuch
        return text

    def _object(self, value: dict[object, object], depth: int) -> object:
        items = list(dict.items(value))
        if not all(issubclass(type(key), str) for key, _ in items):
            return {"$text": self._text(shown(value))}
        named = {self._text(cast("str", key)): part for key, part in items}
        if any(name[:1] == "$" for name in named):
            return {"$text": self._text(shown(value))}
        return {name: self.data(part, depth + 1) for name, part in named.items()}


_BITS = int(MOST_DIGITS / log10(2))


def _photo_data(photo: Photo) -> object:
    x, y, z = (float(number) for number in photo.position)
    data: Data = {
        "position": [x, y, z],
        "width": float(photo.width),
        "height": float(photo.height),
        "sees": [str(what) for what in photo.sees],
        "sharpness": float(photo.sharpness),
    }
    if photo.file is not None:  # journals from before know no such thing
        data["file"] = str(photo.file)
    return {"$photo": data}
