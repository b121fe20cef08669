"""What counts as a truth, a number or a text: one rule for all that hooks give and leave behind.

Objects of other libraries count by what they can be asked, and by no name: numpy's scalars have `item()`.
"""

from __future__ import annotations

from math import isfinite, log10
from operator import index
from typing import Any, TypeVar

from .text import MOST_DIGITS

T = TypeVar("T")

MOST_BITS = int(MOST_DIGITS / log10(2))
_FLOAT_BITS = 1_000
"""Of a whole number; a longer one is none. And of one that a float holds."""

_LARGEST = 1e12  # of a field, a coordinate, a time


def plain_of(value: Any) -> Any:
    """Return a truth, a number or a text as one of Python's own, NaN and infinity too; None: it is none."""
    try:
        if hasattr(value, "item") and not isinstance(value, (int, float, str)):
            # a scalar, or an array of no dimension
            value = value.item() if getattr(value, "shape", ()) == () else None
        if isinstance(value, bool):
            return value
        if isinstance(value, str):
            return str.__str__(value)
        if not isinstance(value, float) and hasattr(value, "__index__"):
            return int(index(value))
        return float(value) if hasattr(value, "__float__") else None
    except Exception:  # noqa: BLE001 - it is of a class of a hook's own
        return None


def as_a(kind: type[T], value: object) -> T | None:
    """Return a value as a plain one of this type; None: it is not one, not finite, or too large to keep."""
    plain = plain_of(value)
    if type(plain) is int and plain.bit_length() > (_FLOAT_BITS if kind is float else MOST_BITS):
        return None
    if kind is float and type(plain) is int:
        plain = float(plain)
    if type(plain) is float and not isfinite(plain):
        return None
    return plain if type(plain) is kind else None


def number_of(value: object) -> float | None:
    """Return a finite number of bounded size as a plain `int` or `float`; None: it is not one."""
    number = plain_of(value)
    return number if type(number) in (int, float) and abs(number) < _LARGEST else None
