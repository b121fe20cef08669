"""What counts as a truth, a number or a text, of Python's own classes and of other libraries'."""

from __future__ import annotations

from decimal import Decimal
from enum import IntEnum, StrEnum
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from pluto_fleet.shared.domain.plain import as_a, number_of, plain_of


class Scalar:
    """A scalar of a library that nobody here knows."""

    def __init__(self, value: object, shape: tuple[int, ...] = ()) -> None:
        self.value = value
        self.shape = shape

    def item(self) -> object:
        return self.value

    def __float__(self) -> float:
        return 1.0


class Level(IntEnum):
    """A number with a name."""

    HIGH = 3


class Colour(StrEnum):
    """A text with a name."""

    RED = "red"


def refuses(*_: object) -> Any:
    raise ValueError


@pytest.mark.parametrize(
    ("value", "plain"),
    [
        *((np.bool_(False), False), (np.True_, True), (np.array(True), True), (Scalar(True), True)),
        *((np.uint8(3), 3), (np.int64(-3), -3), (Level.HIGH, 3), (Scalar(3), 3)),
        *((np.float16(1.5), 1.5), (np.float64(1.5), 1.5), (np.longdouble(1.5), 1.5)),
        *((Decimal("1.5"), 1.5), (Fraction(3, 2), 1.5), (np.array(1.5), 1.5), (Scalar(1.5), 1.5)),
        *((np.str_("x"), "x"), (Colour.RED, "red"), (Scalar("x"), "x")),
        *((wrong, None) for wrong in (None, b"x", 1j, np.complex64(1), [1.0], np.array([1.0]))),
        *((wrong, None) for wrong in (np.timedelta64(3, "s"), Scalar(1.5, (1,)), Scalar([1.0]))),
        (type("Odd", (), {"item": refuses, "__index__": refuses, "__float__": refuses})(), None),
    ],
)
def test_what_a_hook_gives_is_one_plain_value_or_none(value: object, plain: object) -> None:
    """A truth is no number, a number no truth, whatever class it is of."""
    assert (plain_of(value), type(plain_of(value))) == (plain, type(plain))
    kinds: tuple[type[Any], ...] = (bool, int, str)
    assert [as_a(kind, value) for kind in kinds] == [
        plain if type(plain) is kind else None for kind in kinds
    ]
    number = plain if type(plain) in (int, float) else None
    assert as_a(float, value) == number_of(value) == number


@pytest.mark.parametrize("made", [float, np.float16, np.float32, np.longdouble, Decimal])
@pytest.mark.parametrize("odd", ["nan", "inf", "-inf"])
def test_no_width_has_a_number_that_is_not_finite(made: Any, odd: str) -> None:
    assert as_a(float, made(odd)) is number_of(made(odd)) is None


@pytest.mark.parametrize(
    ("value", "number", "whole", "real"),
    [
        (10**12 - 1, 10**12 - 1, 10**12 - 1, 1e12 - 1),
        (10**12, None, 10**12, 1e12),
        (np.uint64(2**63), None, 2**63, 2.0**63),
        (10**400, None, 10**400, None),
        (10**700, None, None, None),
        (0.99e12, 0.99e12, None, 0.99e12),
        (1e300, None, None, 1e300),
    ],
)
def test_a_number_has_a_bounded_size(
    value: object, number: object, whole: object, real: object
) -> None:
    """That of a field or a coordinate another than that of a result, which is only kept."""
    assert (number_of(value), as_a(int, value), as_a(float, value)) == (number, whole, real)
