"""Types for argparse: numbers within bounds."""

from __future__ import annotations

from argparse import ArgumentTypeError
from collections.abc import Callable
from math import isfinite

from .shared.domain.quantities import typed, whole
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
