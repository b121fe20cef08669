"""Converting values of TOML, with messages such as `delay "3 m" is a length, not a time`.

Numbers have limits, so that nothing that is computed from them divides by zero or overflows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import isfinite
from typing import TYPE_CHECKING

from plutoc_runtime.domain.fields import FieldType, time_of_day
from plutoc_runtime.domain.quantities import QUANTITIES, Type, parse_quantity, units_of
from plutoc_runtime.domain.text import number

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """The range of a number."""

    least: float
    most: float
    unit: str = ""
    or_none: bool = False
    """Whether it may also be 0, meaning none."""

    def problem(self, amount: float) -> str | None:
        """Return what is wrong with an amount, and what would not be."""
        if self.least <= amount <= self.most or (self.or_none and amount == 0):
            return None
        beyond = f"less than {self._written(self.least)}"
        if amount > self.most:
            beyond = f"more than {self._written(self.most)}"
        elif self.or_none and amount < 0:
            beyond = "less than 0"
        none = "0, or " if self.or_none else ""
        return f"is {beyond}: it may be {none}{self._written(self.least)} to {self._written(self.most)}"

    def _written(self, amount: float) -> str:
        written = number(amount) if abs(amount) < 10_000 else f"{amount:,.0f}"
        return f"{written} {self.unit}".strip()


SIDE = Limit(least=0.1, most=10_000.0, unit="m")
"""Of a map."""
HEIGHT = Limit(least=0.1, most=1000.0, unit="m")
"""At which drones cruise, or above which none flies."""
PLACE = Limit(least=-100_000.0, most=100_000.0, unit="m")
"""A coordinate, be it on the map or not."""
APART = Limit(least=0.05, most=10.0, unit="m", or_none=True)
"""What lies between two drones."""
RADIUS = Limit(least=0.01, most=100_000.0, unit="m")
"""Of something that is seen or measured."""
MASS = Limit(least=0.0, most=1000.0, unit="kg")
"""Of an item."""
TIME = Limit(least=0.001, most=1e9, unit="s", or_none=True)
"""A delay, a limit, a distance of rounds: 30 years at most."""


LARGEST = 1e9
"""The largest number of a field: 30 years, for a time; nothing computed from it overflows."""

LONGEST_NAME = 200


class Wrong(ValueError):
    """An invalid value; the message continues after the key and the value."""


def name(value: object) -> str:
    """Read a word that will stand in lists and logs."""
    word = text(value)
    if not word.strip():
        raise Wrong("is empty")
    if word != word.strip():
        raise Wrong("begins or ends with a blank")
    if len(word) > LONGEST_NAME:
        raise Wrong(f"is longer than {LONGEST_NAME} characters")
    if not word.isprintable():
        raise Wrong("holds a character that cannot be shown")
    return word


def text(value: object) -> str:
    """Read any text."""
    if not isinstance(value, str):
        raise Wrong("is not a text: put it in quotes")
    return value


def boolean(value: object) -> bool:
    """Read true or false."""
    if not isinstance(value, bool):
        raise Wrong("is neither true nor false")
    return value


def integer(value: object, *, least: int | None = None) -> int:
    """Read a whole number."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise Wrong("is not a whole number")
    if abs(value) > LARGEST:
        raise Wrong("is too large")
    if least is not None and value < least:
        raise Wrong(f"is less than {least}")
    return value


def real(value: object) -> float:
    """Read a number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise Wrong("is not a number")
    if isinstance(value, float) and not isfinite(value):
        raise Wrong("is not a finite number")
    if abs(value) > LARGEST:
        raise Wrong("is too large")
    return float(value)


def quantity(value: object, kind: Type, *, limit: Limit | None = None) -> float:
    """Read "3 min" or 180 as 180.0."""
    if isinstance(value, str):
        amount = real(parse_quantity(value, kind))
    elif isinstance(value, bool) or not isinstance(value, int | float):
        units = ", ".join(units_of(kind))
        raise Wrong(f"is not a {kind.value}: write a number, or a text with a unit ({units})")
    else:
        amount = real(value)
    problem = None if limit is None else limit.problem(amount)
    if problem is not None:
        raise Wrong(problem)
    return amount


def parameter(value: object, kind: Type) -> Plain:
    """Read the value of an action's parameter."""
    if kind in QUANTITIES:
        return quantity(value, kind)
    return _PLAIN[kind](value)


_PLAIN: dict[Type, Callable[[object], Plain]] = {
    Type.INT: integer,
    Type.FLOAT: real,
    Type.BOOL: boolean,
    Type.TEXT: text,
}


def numbers(value: object, counts: tuple[int, ...], limit: Limit = PLACE) -> tuple[float, ...]:
    """Read a list of lengths, with these numbers of elements."""
    wanted = " or ".join(str(count) for count in counts)
    if not isinstance(value, list) or len(value) not in counts:
        raise Wrong(f"is not a list of {wanted} numbers")
    try:
        return tuple(quantity(element, Type.LENGTH, limit=limit) for element in value)
    except ValueError as error:
        raise Wrong(f"has an element that {error}") from None


def corner(value: object) -> tuple[float, float]:
    """Read [x, y]."""
    x, y = numbers(value, (2,))
    return x, y


def position(value: object, height: float) -> tuple[float, float, float]:
    """Read [x, y] or [x, y, z]; without z it is at this height."""
    x, y, *z = numbers(value, (2, 3))
    return x, y, z[0] if z else height


def rounds(value: object) -> int | bool:
    """Read how many more rounds; true: until stopped."""
    if value is True:
        return True
    if value is False or not isinstance(value, int) or value < 0:
        raise Wrong("is neither a whole number from 0 on nor true")
    return integer(value)


def field_reader(kind: FieldType) -> Callable[[object], object]:
    """Return how a field of this type is read."""
    return _FIELDS[kind]


_FIELDS: dict[FieldType, Callable[[object], object]] = {
    FieldType.TIME: partial(quantity, kind=Type.TIME, limit=TIME),
    FieldType.INT: integer,
    FieldType.ROUNDS: rounds,
    FieldType.TIME_OF_DAY: time_of_day,
    FieldType.EVALUATOR: name,
}
