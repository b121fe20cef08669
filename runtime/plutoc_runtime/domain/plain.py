"""What counts as a truth, a number or a text: one rule for all that hooks give and leave behind.

Objects of other libraries count by what they can be asked, and by no name: numpy's scalars have `item()`.
"""

from __future__ import annotations

from math import isfinite, log10
from operator import index
from typing import Any, TypeVar

from .errors import ANY_ERROR
from .guard import unless_by_a_person
from .text import MOST_DIGITS

T = TypeVar("T")

MOST_BITS = int(MOST_DIGITS / log10(2))
_FLOAT_BITS = 1_000
"""Of a whole number; a longer one is none. And of one that a float holds."""

_LARGEST = 1e12  # of a field, a coordinate, a time


def plain_of(value: object) -> Any:
    """Return a truth, a number or a text as one of Python's own, NaN and infinity too; None: it is none."""
    try:
        return _plain(value)
    except ANY_ERROR as error:  # an error of its own class
        unless_by_a_person(error)
        return None


def _plain(value: Any) -> Any:
    kind = type(value)
    if not issubclass(kind, (int, float, str)) and callable(item := getattr(kind, "item", None)):
        # a scalar, or an array of no dimension
        value = item(value) if getattr(value, "shape", ()) == () else None
        kind = type(value)
    if kind is bool:
        return value
    if issubclass(kind, str):
        return str.__str__(value)
    if issubclass(kind, float):
        return float.__pos__(value)
    if hasattr(kind, "__index__"):
        return int.__pos__(index(value))
    return float.__pos__(float(value)) if hasattr(kind, "__float__") else None


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
