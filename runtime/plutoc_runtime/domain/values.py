"""What a plan may hold: its values, with messages such as `delay "3 m" is a length, not a time`.

And what no value breaks alone: homes apart, and items picked and released in turn.

Numbers have limits, so that nothing that is computed from them divides by zero or overflows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, time
from math import dist, isfinite
from typing import TYPE_CHECKING, Any

from .actions import PICK, RELEASE
from .airspace import covers_ground
from .errors import BadInput
from .fields import FieldType, time_of_day
from .model import AfterTrip
from .quantities import QUANTITIES, UNITS, Type, parse_quantity, units_of
from .text import number, percent, quoted

if TYPE_CHECKING:
    from .actions import Action
    from .airspace import Corner
    from .model import Item, Point, Trip

Read = Callable[[Any], Any]
"""Converts a value; raises a `ValueError` whose message continues after the key and the value."""

LARGEST, LONGEST_NAME = 1e9, 200
"""The largest number is 30 years, for a time: nothing computed from it overflows."""


def shown(value: object) -> str:
    """Format a value as in the file, shortened."""
    match value:
        case str():
            return quoted(value)
        case list() | dict():
            return "{…}" if isinstance(value, dict) else "[…]" if value else "[]"
        case date() | time():
            return value.isoformat()
        case float() | bool():
            return f"{value}".lower()
        case int() if abs(value) <= 10**30:  # 0xfff… may have more digits than Python writes
            return f"{value}"
    return "this number" if isinstance(value, int) else "this value"


def _such_as(*rules: tuple[Callable[[Any], object], str], to: Read | None = None) -> Read:
    """Return a reader of what keeps these rules; each has the message about what breaks it."""

    def read(value: object) -> object:
        for holds, said in rules:
            if not holds(value):
                raise ValueError(said)
        return value if to is None else to(value)

    return read


_TEXT = (lambda value: isinstance(value, str), "is not a text: put it in quotes")
_NUMBER = (lambda value: type(value) in (int, float), "is not a number")
_WHOLE = (lambda value: type(value) is int, "is not a whole number")
_FINITE = (lambda value: type(value) is int or isfinite(value), "is not a finite number")
_SMALL = (lambda value: abs(value) <= LARGEST, "is too large")
_ROUNDS = "is neither a whole number from 0 on nor true"
_AREAS = "is not a list of areas, each a list of corners [x, y]"
_AFTER = [one.value for one in AfterTrip]

text = _such_as(_TEXT)
name = _such_as(
    _TEXT,
    (str.strip, "is empty"),
    (lambda value: value == value.strip(), "begins or ends with a blank"),
    (lambda value: len(value) <= LONGEST_NAME, f"is longer than {LONGEST_NAME} characters"),
    (str.isprintable, "holds a character that cannot be shown"),
)
"""A word that will stand in lists and logs."""
boolean = _such_as((lambda value: isinstance(value, bool), "is neither true nor false"))
real = _such_as(_NUMBER, _FINITE, _SMALL, to=float)
integer = _such_as(_WHOLE, _SMALL)
count = _such_as(_WHOLE, _SMALL, (lambda value: value >= 1, "is less than 1"))
rounds = _such_as((lambda v: v is True or (type(v) is int and v >= 0), _ROUNDS), _SMALL)
"""How many more; true: until stopped."""
after_trip = _such_as((_AFTER.__contains__, f"is none of: {', '.join(_AFTER)}"), to=AfterTrip)
areas = _such_as((lambda value: isinstance(value, list), _AREAS))


@dataclass(frozen=True, slots=True)
class Quantity:
    """Reads "3 min" or 180 as 180.0, within limits; `or_none`: 0 is as good."""

    kind: Type
    least: float = -LARGEST
    most: float = LARGEST
    or_none: bool = False

    def __call__(self, value: object) -> float:
        """Read one."""
        given = parse_quantity(value, self.kind) if isinstance(value, str) else value
        if type(given) not in (int, float):
            wanted = f"write a number, or a text with a unit ({', '.join(units_of(self.kind))})"
            raise ValueError(f"is not a {self.kind.value}: {wanted}")
        amount: float = real(given)
        if self.least <= amount <= self.most or (self.or_none and amount == 0):
            return amount
        least, most = self._written(self.least), self._written(self.most)
        beyond = f"more than {most}" if amount > self.most else f"less than {least}"
        if self.or_none and amount < 0:
            beyond = "less than 0"
        raise ValueError(f"is {beyond}: it may be {'0, or ' * self.or_none}{least} to {most}")

    def _written(self, amount: float) -> str:
        if self.kind is Type.PERCENT:
            return percent(amount)
        unit = next(one for one in units_of(self.kind) if UNITS[one][1:] == (1.0, 0.0))
        return f"{number(amount) if abs(amount) < 10_000 else f'{amount:,.0f}'} {unit}".strip()


SIDE = Quantity(Type.LENGTH, 0.1, 10_000.0)  # of a map
HEIGHT = Quantity(Type.LENGTH, 0.1, 1000.0)
PLACE = Quantity(Type.LENGTH, -100_000.0, 100_000.0)  # a coordinate, be it on the map or not
RADIUS = Quantity(Type.LENGTH, 0.01, 100_000.0)  # of something that is seen or measured
MASS = Quantity(Type.MASS, 0.0, 1000.0)  # of an item
TIME = Quantity(Type.TIME, 0.001, LARGEST, or_none=True)  # a delay, a limit, between two rounds

_OVERHEAD = Quantity(Type.TIME, 0.0, 600.0)
_SPREAD, _TAPER = Quantity(Type.PERCENT, 0.0, 0.3), Quantity(Type.PERCENT, 0.0, 0.5)
_FACTOR = Quantity(Type.PERCENT, 0.1, 10.0)
_LEGS = ("smooth", "straight")

MOTION: dict[str, Read] = {
    "legs": _such_as((_LEGS.__contains__, f"is none of: {', '.join(_LEGS)}")),
    "limit": Quantity(Type.SPEED, 0.01, 100.0),
    **dict.fromkeys(("take_off", "settles", "landing"), _OVERHEAD),
    **dict.fromkeys(("pace", "drain"), _FACTOR),
    **dict.fromkeys(("spread", "action_spread"), _SPREAD),
    "taper": _TAPER,
}
"""How the keys of a fleet's `[motion]` are read."""


def numbers(*counts: int, each: Quantity = PLACE) -> Read:
    """Return a reader of a list of lengths, with one of these numbers of elements."""

    def read(value: object) -> object:
        if not isinstance(value, list) or len(value) not in counts:
            raise ValueError(f"is not a list of {' or '.join(map(str, counts))} numbers")
        try:
            return tuple(map(each, value))
        except ValueError as error:
            raise ValueError(f"has an element that {error}") from None

    return read


size, corner, point = numbers(2, each=SIDE), numbers(2), numbers(2, 3)
"""Of a map; [x, y]; [x, y] or [x, y, z]."""


def area(value: object) -> tuple[Corner, ...]:
    """Read the corners of a no-fly area."""
    if not isinstance(value, list) or len(value) < 3:
        raise ValueError("is not a list of at least three corners [x, y]")
    corners: list[Corner] = []
    for place, element in enumerate(value, 1):
        try:
            corners.append(corner(element))
        except ValueError as error:
            raise ValueError(f"has a corner {place} that {error}") from None
    if not covers_ground(corners):
        raise ValueError("covers no ground: its corners lie on one line")
    return tuple(corners)


PARAMETER: dict[FieldType | Type, Read] = {
    Type.INT: integer,
    Type.FLOAT: real,
    Type.BOOL: boolean,
    Type.TEXT: text,
    **{kind: Quantity(kind) for kind in QUANTITIES},
}
"""How an action's parameter is read."""


def parameters(action: Action, given: Mapping[str, object]) -> dict[str, Any]:
    """Read an action's parameters, defaults included; raise `ValueError` with what is wrong."""
    found: dict[str, Any] = {one.name: one.default for one in action.parameters}
    for name in given:
        if not found:
            raise ValueError(f"{action.name} has no parameters, and {quoted(name)} is given")
        if name not in found:
            raise ValueError(f"unknown parameter {quoted(name)}; there may be: {', '.join(found)}")
    for one in action.parameters:
        try:
            if one.name in given:
                found[one.name] = PARAMETER[one.type](given[one.name])
        except ValueError as error:
            raise ValueError(f"{one.name} {shown(given[one.name])} {error}") from None
        if found[one.name] is None:
            raise ValueError(f"{action.name} needs the parameter {one.name}")
    return found


FIELD: dict[FieldType | Type, Read] = {
    **PARAMETER,
    FieldType.TIME: TIME,
    FieldType.INT: integer,
    FieldType.ROUNDS: rounds,
    FieldType.TIME_OF_DAY: time_of_day,
    FieldType.EVALUATOR: name,
}
"""How a field of a mission or a trip is read."""

HOME_SIZE = 0.1  # the diameter of a drone on the ground, in metres

Cells = dict[tuple[int, int], list[tuple["Point", str]]]
"""Homes and their drones, by squares of the map with sides of that length."""


def new_name(what: str) -> Read:
    """Return a reader of names that must differ."""
    names = set[str]()

    def read(value: object) -> str:
        found: str = name(value)
        if found in names:
            raise BadInput(f"there is another {what} {quoted(found)}: names must differ")
        names.add(found)
        return found

    return read


def crowded(home: Point, drone: str, homes: Cells) -> str | None:
    """Add a home to the others; return what is wrong if it is too near to one of them."""
    x, y = int(home[0] // HOME_SIZE), int(home[1] // HOME_SIZE)
    around = [homes.get((x + i, y + j), []) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    near = [other for cell in around for at, other in cell if dist(home, at) < HOME_SIZE]
    homes.setdefault((x, y), []).append((home, drone))
    if not near:
        return None
    return f"home is where drone {quoted(near[0])} has its own: each needs a place to stand"


def wrongly_carried(trips: Sequence[Trip]) -> Iterator[tuple[int, str]]:
    """Yield each pick without a release, release without a pick, and second item aboard.

    With the index of its trip.
    """
    aboard: tuple[int, Trip, Item] | None = None
    for index, trip in enumerate(trips):
        if trip.action not in (PICK, RELEASE):
            continue
        if trip.item is None:
            return  # it is invalid: errors after it would be guesses
        item = quoted(trip.item.name)
        _, since, carried = aboard or (index, trip, None)
        if trip.action == PICK and carried is not None:
            name = quoted(carried.name)
            yield index, f"picks {item}, but {name} is still aboard since trip {since.name}"
        elif trip.action == RELEASE and carried is None:
            yield index, f"releases {item}, which no trip before it has picked"
        elif trip.action == RELEASE and carried is not None and carried != trip.item:
            other = f"releases {item}, but trip {since.name} picked {quoted(carried.name)}"
            same = f"{item} has another mass here than in trip {since.name}"
            yield index, same if carried.name == trip.item.name else other
        aboard = (index, trip, trip.item) if trip.action == PICK else None
    if aboard is not None:
        index, _, carried = aboard
        yield index, f"picks {quoted(carried.name)}, which no trip after it releases"
