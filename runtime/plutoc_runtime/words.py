"""How numbers, places and names are written for people."""

from __future__ import annotations

import re
from reprlib import Repr
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .model import Point

LONGEST = 60


def quoted(text: str) -> str:
    """Put a user's word in quotes; nothing in it can command a terminal."""
    return f'"{printable(cut_off(text, LONGEST))}"'


def in_shell(text: object) -> str:
    """Write a word of a command line so that a shell takes it as it is, and runs nothing of it."""
    from shlex import quote  # only who is told what to type needs it

    return quote(str(text))


def number(value: float) -> str:
    """Write a number with three decimals at most: 2, 0.5, 1.333."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def place(point: Point) -> str:
    """Write where something is on the map."""
    return f"({number(point[0])}, {number(point[1])})"


def duration(seconds: float) -> str:
    """Write a time: 42.5 s, 3 min 20 s, 2 h 5 min."""
    if seconds < 60:
        return f"{number(round(seconds, 1))} s"
    whole = round(seconds)
    hours, minutes, rest = whole // 3600, whole % 3600 // 60, whole % 60
    if hours:
        return f"{hours} h {minutes} min" if minutes else f"{hours} h"
    return f"{minutes} min {rest} s" if rest else f"{minutes} min"


def mass(kilograms: float) -> str:
    """Write a mass: 8 g, 1.5 kg."""
    if kilograms < 1:
        return f"{number(kilograms * 1000)} g"
    return f"{number(kilograms)} kg"


def percent(share: float) -> str:
    """Write a share: 20 %."""
    return f"{share * 100:.0f} %"


def counted(count: int, one: str, many: str | None = None) -> str:
    """Write how many there are: 1 trip, 2 trips."""
    return f"{count} {one if count == 1 else many or one + 's'}"


def of(drone: str, reason: str) -> str:
    """Say of which drone a reason speaks, if it does not say so itself."""
    return reason if reason.startswith(f"{drone} ") else f"{drone}: {reason}"


def printable(text: str) -> str:
    """Escape what a terminal would take as a command."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def cut_off(text: str, longest: int) -> str:
    """Write no more of a text than so many characters."""
    return text if len(text) <= longest else text[: longest - 1] + "…"


def shown(value: object) -> str:
    """Write any value so that it is the same text in every run."""
    if value is None or isinstance(value, (bool, int, float)):
        return repr(value)
    return _ADDRESS.sub("", _EVERYTHING.repr(value))


class _Everything(Repr):
    """Like `repr`, but sets are sorted, and an error of an object's own is no error here."""

    def __init__(self) -> None:
        super().__init__()
        self.maxlevel = 20
        self.maxtuple = self.maxlist = self.maxdict = self.maxset = self.maxfrozenset = 10_000
        self.maxarray = self.maxdeque = self.maxstring = self.maxlong = self.maxother = 100_000


_EVERYTHING, _ADDRESS = _Everything(), re.compile(r" at 0x[0-9A-Fa-f]+")
