"""Numbers with units: one table for the language, the plan files and the hooks.

Inside, everything is SI: seconds, metres, kilograms, radians, metres a second, kelvin; a percentage
is a number from 0 to 1. `m` is the metre, never the minute.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from enum import Enum
from math import isfinite, pi
from typing import TypeVar

from .text import quoted

T = TypeVar("T")


class Type(Enum):
    """The type of a parameter or a field, named as in the language."""

    INT = "int"
    FLOAT = "float"
    BOOL = "bool"
    TEXT = "text"
    MASS = "mass"
    LENGTH = "length"
    TIME = "time"
    ANGLE = "angle"
    PERCENT = "percent"
    SPEED = "speed"
    TEMPERATURE = "temperature"

    __hash__ = object.__hash__


UNITS: dict[str, tuple[Type, float, float]] = {
    "ms": (Type.TIME, 0.001, 0.0),
    "s": (Type.TIME, 1.0, 0.0),
    "min": (Type.TIME, 60.0, 0.0),
    "h": (Type.TIME, 3600.0, 0.0),
    "mm": (Type.LENGTH, 0.001, 0.0),
    "cm": (Type.LENGTH, 0.01, 0.0),
    "m": (Type.LENGTH, 1.0, 0.0),
    "km": (Type.LENGTH, 1000.0, 0.0),
    "mg": (Type.MASS, 1e-6, 0.0),
    "g": (Type.MASS, 0.001, 0.0),
    "kg": (Type.MASS, 1.0, 0.0),
    "deg": (Type.ANGLE, pi / 180, 0.0),
    "rad": (Type.ANGLE, 1.0, 0.0),
    "%": (Type.PERCENT, 0.01, 0.0),
    "m/s": (Type.SPEED, 1.0, 0.0),
    "km/h": (Type.SPEED, 1 / 3.6, 0.0),
    "C": (Type.TEMPERATURE, 1.0, 273.15),
    "K": (Type.TEMPERATURE, 1.0, 0.0),
}
"""Unit: what it measures, and the factor and offset that make it SI."""

QUANTITIES = frozenset(kind for kind, _, _ in UNITS.values())  # the types that take a unit

_QUANTITY = re.compile(r"\s*([+-]?\d+(?:\.\d+)?)\s*([A-Za-z%]+(?:/[A-Za-z]+)?)?\s*")


def units_of(kind: Type) -> tuple[str, ...]:
    """Return the units of a type, in the table's order."""
    return tuple(unit for unit, (measures, _, _) in UNITS.items() if measures is kind)


def to_si(value: float, unit: str) -> float:
    """Return the value in SI units; the unit is one of `UNITS`."""
    _, factor, offset = UNITS[unit]
    # 15 digits: 50 mg is 5e-05 kg, not 4.9999999999999996e-05, in files that people read
    return float(f"{value * factor + offset:.15g}")


def a_kind(kind: Type) -> str:
    """Return the name of a type with its article."""
    return f"{'an' if kind is Type.ANGLE else 'a'} {kind.value}"


def parse_quantity(text: str, kind: Type) -> float:
    """Read "3 min" as 180.0; raise ValueError with a sentence for a person."""
    wanted = ", ".join(units_of(kind))
    match = _QUANTITY.fullmatch(text)
    if match is None or match[2] not in (None, *UNITS):
        raise ValueError(f"is not {a_kind(kind)}: write a number and a unit ({wanted})")
    number, unit = float(match[1]), match[2]
    if not isfinite(number):
        raise ValueError("is not a finite number")
    if unit is None:
        return number
    if UNITS[unit][0] is not kind:
        raise ValueError(f"is {a_kind(UNITS[unit][0])}, not {a_kind(kind)}: it takes {wanted}")
    return to_si(number, unit)


def time_from(text: str) -> float:
    """Read a positive time: 7200, "2 h"."""
    try:
        seconds = parse_quantity(text, Type.TIME)
    except ValueError as error:
        raise ValueError(f"{quoted(text)} {error}") from None
    if seconds <= 0:
        raise ValueError(f"{quoted(text)} is not more than 0")
    return seconds


def whole(text: str) -> int:
    """Read a whole number; raise ValueError with a sentence for a person."""
    try:
        return int(text)
    except ValueError:
        raise ValueError(f"{quoted(text)} is not a whole number") from None


def typed(read: Callable[[str], T]) -> Callable[[str], T]:
    """Wrap a reader for argparse, so that argparse shows its message."""
    from argparse import ArgumentTypeError

    def converted(text: str) -> T:
        try:
            return read(text)
        except ValueError as error:
            raise ArgumentTypeError(str(error)) from None

    return converted
