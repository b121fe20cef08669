"""Formatting numbers, places and names for people."""

from __future__ import annotations

import re
from collections.abc import Sequence
from reprlib import Repr
from typing import Any

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
    """Return `str(value)`, or a default if that raises; what has no text of its own is shown."""
    write = type(value).__str__
    try:
        if isinstance(value, BaseException) and write is BaseException.__str__ and value.args:
            only, *more = value.args
            return shown(value.args) if more else text_of(only, otherwise)
        return shown(value) if write is object.__str__ else str(value)
    except Exception:  # noqa: BLE001 - it is of a class of a hook's own
        return otherwise


def shown(value: object) -> str:
    """Format any value as a bounded text that is the same in every run."""
    try:
        if value is None or type(value) in (bool, float):
            return repr(value)
        return bounded(_ADDRESS.sub("", _Everything().repr(value)), LONGEST_VALUE)
    except Exception:  # noqa: BLE001 - it is of a class of a hook's own
        return f"<{class_of(value)} that cannot be shown>"


def said(error: BaseException) -> str:
    """Return an error's type and text."""
    text = f"{class_of(error)}: {text_of(error)}".removesuffix(": ")
    return bounded(text, LONGEST_REASON)


def class_of(value: object) -> str:
    """Return the name of a value's class."""
    return bounded(type(value).__name__, LONGEST)


LONGEST_REASON = 2_000  # characters of what a hook says of a failure
LONGEST_LOG = 20_000  # characters of a line that it has logged
LONGEST_VALUE = 10_000  # characters of a value that is kept as text
_PARTS = 10_000
"""Elements of it that are looked at: each may hold many others, and these the same ones."""


class _Everything(Repr):
    """Like `repr`, but sorted and bounded."""

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
        return super().repr1(x, level) if self._left >= 0 else "…"


MOST_DIGITS = 600  # a number with more is kept as text: not every reader of JSON takes it

_ADDRESS = re.compile(r" at 0x[0-9A-Fa-f]+")
