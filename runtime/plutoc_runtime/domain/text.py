"""Formatting numbers, places and names for people."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import log10
from reprlib import Repr
from typing import Any, cast

from .errors import ANY_ERROR
from .guard import unless_by_a_person

LONGEST = 60


def quoted(text: str) -> str:
    """Quote a user's text, with control characters escaped."""
    return f'"{printable(cut_off(text, LONGEST))}"'


def number(value: float) -> str:
    """Format a number with up to three decimals: 2, 0.5, 1.333."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def place(point: Sequence[float]) -> str:
    """Format a point of the map."""
    return f"({number(point[0])}, {number(point[1])})"


def duration(seconds: float) -> str:
    """Format a duration: 42.5 s, 3 min 20 s, 2 h 5 min."""
    if seconds < 60:
        return f"{number(round(seconds, 1))} s"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min" if minutes else f"{hours} h"
    return f"{minutes} min {rest} s" if rest else f"{minutes} min"


def mass(kilograms: float) -> str:
    """Format a mass: 8 g, 1.5 kg."""
    if kilograms < 1:
        return f"{number(kilograms * 1000)} g"
    return f"{number(kilograms)} kg"


def percent(share: float) -> str:
    """Format a share: 20 %."""
    return f"{share * 100:.0f} %"


def counted(count: int, one: str) -> str:
    """Format a count: 1 trip, 2 trips."""
    return f"{count} {one if count == 1 else one + 's'}"


def printable(text: str) -> str:
    """Escape control characters."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def cut_off(text: str, longest: int) -> str:
    """Truncate a text to a number of characters."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def bounded(text: str, longest: int) -> str:
    """Truncate a text to a number of characters, and add its length."""
    if len(text) <= longest:
        return text
    return f"{text[:longest]}… ({len(text):,} characters in all)"


def text_of(value: object, otherwise: str = "") -> str:
    """Return `str(value)`, or a default if that raises."""
    kind = type(value)
    if kind is str:
        return cast("str", value)
    try:
        if issubclass(kind, BaseException) and kind.__str__ in (_AN_ERRORS, KeyError.__str__):
            given = cast("BaseException", value).args  # which may be anything
            if len(given) != 1:
                return shown(given) if given else ""
            return text_of(given[0], otherwise) if kind.__str__ is _AN_ERRORS else shown(given[0])
        if kind.__str__ is object.__str__:  # a list, and all that has no text of its own
            return shown(value)
        return str.__str__(str(value))  # which may be of a class of its own
    except ANY_ERROR as error:  # an error of its own class
        unless_by_a_person(error)
        return otherwise


_AN_ERRORS = BaseException.__str__


def shown(value: object) -> str:
    """Format any value as a bounded text that is the same in every run."""
    try:
        if value is None or type(value) in (bool, float):
            return repr(value)
        return bounded(_ADDRESS.sub("", _Everything().repr(value)), LONGEST_VALUE)
    except ANY_ERROR as error:  # an error of its own class
        unless_by_a_person(error)
        return f"<{class_of(value)} that cannot be shown>"


def said(error: BaseException) -> str:
    """Return an error's type and text."""
    text = f"{class_of(error)}: {text_of(error)}".removesuffix(": ")
    return bounded(text, LONGEST_REASON)


def class_of(value: object) -> str:
    """Return the name of a value's class, even if its metaclass hides it."""
    name: str = type.__dict__["__name__"].__get__(type(value))
    return bounded(str.__str__(name), LONGEST)


LONGEST_REASON, LONGEST_LOG = 2_000, 20_000
"""Characters of what a hook says of a failure, and of a line that it has logged."""

LONGEST_VALUE = 10_000  # characters of a value that is kept as text

_PARTS = 10_000
"""Elements of it that are looked at: each may hold many others, and these the same ones."""


class _Everything(Repr):
    """Like `repr`, but sorted, bounded, and safe against objects that raise."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 20
        self.maxtuple = self.maxlist = self.maxdict = self.maxset = self.maxfrozenset = _PARTS
        self.maxarray = self.maxdeque = _PARTS
        self.maxstring = self.maxlong = self.maxother = 2 * LONGEST_VALUE
        self._left = _PARTS

    def repr1(self, x: Any, level: int) -> str:
        """Write a part of it."""
        self._left -= 1
        kinds: tuple[Any, ...] = (list, tuple, dict)
        for kind in kinds:  # a class that is made of one of these is written as that
            if type(x) is not kind and type(x).__repr__ is kind.__repr__:
                x = kind(kind.__iter__(x)) if kind is not dict else dict(dict.items(x))
        return super().repr1(x, level) if self._left >= 0 else "…"

    def repr_int(self, x: int, level: int) -> str:
        """Format an integer, which may have more digits than Python allows."""
        digits = int(x.bit_length() * log10(2)) + 1
        return super().repr_int(x, level) if digits < MOST_DIGITS else f"<int of {digits:,} digits>"


MOST_DIGITS = 600  # a number with more is kept as text: not every reader of JSON takes it

_ADDRESS = re.compile(r" at 0x[0-9A-Fa-f]+")
