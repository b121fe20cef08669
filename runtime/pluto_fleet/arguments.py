"""Types for argparse: numbers within bounds, deadlines and probabilities."""

from __future__ import annotations

from argparse import ArgumentTypeError
from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

from .shared.domain.fields import time_of_day
from .shared.domain.quantities import Type, parse_quantity, time_from, typed, whole
from .shared.domain.text import quoted


def whole_number(least: int | None = None, most: int | None = None) -> Callable[[str], int]:
    """Return a type for a whole number within bounds."""

    def read(text: str) -> int:
        number = typed(whole)(text)
        if most is None:
            if least is not None and number < least:
                raise ArgumentTypeError(f"{quoted(text)} is less than {least}")
        elif not (least or 0) <= number <= most:
            raise ArgumentTypeError(f"{quoted(text)} is not between {least or 0} and {most}")
        return number

    return read


def positive_number(most: float) -> Callable[[str], float]:
    """Return a type for a positive number up to a bound."""

    def read(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            raise ArgumentTypeError(f"{quoted(text)} is not a number") from None
        if not isfinite(number) or not 0 < number <= most:
            raise ArgumentTypeError(f"{quoted(text)} is not between 0 and {most:.0f}")
        return number

    return read


@dataclass(frozen=True, slots=True)
class Deadline:
    """When missions must be completed."""

    text: str
    seconds: float
    """Since midnight, or since the first mission begins."""
    is_time_of_day: bool


def deadline(text: str) -> Deadline:
    """Read 08:30, or a time such as 20min."""
    if ":" not in text:
        return Deadline(text, time_from(text), False)
    try:
        return Deadline(text, time_of_day(text.strip()), True)
    except ValueError as error:
        raise ValueError(f"{quoted(text)} {error}") from None


def confidence(text: str) -> float:
    """Read 99%, or 0.99."""
    try:
        share = parse_quantity(text, Type.PERCENT)
    except ValueError as error:
        raise ValueError(f"{quoted(text)} {error}") from None
    if not 0.5 <= share <= 0.9999:
        raise ValueError(f"{quoted(text)} is not between 50 % and 99.99 %: write it like 99%")
    return share
