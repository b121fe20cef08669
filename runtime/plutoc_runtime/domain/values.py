"""What a person may write: values, and tables of them, with messages such as `delay "3 m" is a length, not a time`.

Numbers have limits, so that nothing that is computed from them divides by zero or overflows. Each mistake is noted
with the path of its key; the reader goes on, with None in its place, and refuses all of it in the end.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, time
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from .airspace import covers_ground
from .errors import BadInput
from .fields import FieldType, time_of_day
from .model import AfterTrip
from .quantities import QUANTITIES, UNITS, Type, a_kind, parse_quantity, units_of
from .text import LONGEST, cut_off, percent, place, quoted
from .text import shown as written

if TYPE_CHECKING:
    from typing import Self

    from .actions import Parameter
    from .airspace import Airspace, Corner
    from .model import Point

Read = Callable[[Any], Any]
"""Converts a value; raises a `ValueError` whose message continues after the key and the value."""

LARGEST, LONGEST_NAME = 1e9, 200
"""The largest number is 30 years, for a time: nothing computed from it overflows."""


def shown(value: object) -> str:
    """Format a value as in the file, shortened."""
    match value:
        case str():
            return quoted(value)
        case bool() | date() | time():
            return f"{value}".lower()
        case list():
            return cut_off(f"[{', '.join(map(shown, value[:LONGEST]))}]", LONGEST)
        case dict():
            return "{…}"
    return cut_off(written(value), LONGEST)


def is_name(value: object) -> bool:
    """Return whether something can be a name, which stands in lists and logs."""
    text = value if isinstance(value, str) else ""
    return 0 < len(text) <= LONGEST_NAME and text == text.strip() and text.isprintable()


def _such(holds: Callable[[Any], object], said: str, value: object) -> object:
    if not holds(value):
        raise ValueError(said)
    return value


def one_of(names: Collection[str], value: object) -> str:
    """Read one of these words."""
    if not isinstance(value, str) or value not in names:
        raise ValueError(f"is none of: {', '.join(names) or 'there are none'}")
    return value


def _whole(least: float, value: object) -> object:
    if type(value) is not int or not least <= value <= LARGEST:
        raise ValueError(f"is not a whole number from {least:,.0f} to {LARGEST:,.0f}")
    return value


_NAME = f"is no name: a text of 1 to {LONGEST_NAME} characters that can be shown, no blank around"

text: Read = partial(_such, lambda value: isinstance(value, str), "is not a text: put it in quotes")
name: Read = partial(_such, is_name, _NAME)
boolean: Read = partial(_such, lambda value: isinstance(value, bool), "is neither true nor false")
integer: Read = partial(_whole, -LARGEST)
count: Read = partial(_whole, 1)


def rounds(value: object) -> object:
    """Read how many more; true: until stopped."""
    if value is not True and (type(value) is not int or not 0 <= value <= LARGEST):
        raise ValueError("is neither a whole number from 0 on nor true")
    return value


def after_trip(value: object) -> AfterTrip:
    """Read what drones do after a trip."""
    return AfterTrip(one_of([one.value for one in AfterTrip], value))


@dataclass(frozen=True, slots=True)
class Quantity:
    """Reads "3 min" or 180 as 180.0, within limits; `or_none`: 0 is as good."""

    kind: Type
    least: float = -LARGEST
    most: float = LARGEST
    or_none: bool = False

    def __call__(self, value: object) -> float:
        """Read one."""
        given: Any = value
        if isinstance(value, str) and self.kind in QUANTITIES:
            given = parse_quantity(value, self.kind)
        none = self.or_none and given == 0
        if type(given) in (int, float) and (none or self.least <= given <= self.most):
            return float(given)
        units = ", ".join(units_of(self.kind))
        kind = f"{a_kind(self.kind)} ({units})" if units else "a number"
        least = "0, or " * self.or_none + self._written(self.least)
        raise ValueError(f"is not {kind} of {least} to {self._written(self.most)}")

    def _written(self, amount: float) -> str:
        if self.kind is Type.PERCENT:
            return percent(amount)
        return f"{amount:,.10g} {_SI.get(self.kind, '')}".strip()


_SI = {kind: unit for unit, (kind, *scale) in UNITS.items() if scale == [1.0, 0.0]}

real = Quantity(Type.FLOAT)
SIDE = Quantity(Type.LENGTH, 0.1, 10_000.0)  # of a map
HEIGHT = Quantity(Type.LENGTH, 0.1, 1000.0)
PLACE = Quantity(Type.LENGTH, -100_000.0, 100_000.0)  # a coordinate, be it on the map or not
RADIUS = Quantity(Type.LENGTH, 0.01, 100_000.0)  # of something that is seen or measured
MASS = Quantity(Type.MASS, 0.0, 1000.0)  # of an item
PACE = Quantity(Type.SPEED, 0.001, 100.0)  # of something that moves by itself
TIME = Quantity(Type.TIME, 0.001, LARGEST, or_none=True)  # a delay, a limit, between two rounds

_OVERHEAD = Quantity(Type.TIME, 0.0, 600.0)
_FACTOR = Quantity(Type.PERCENT, 0.1, 10.0)
_SPREAD = Quantity(Type.PERCENT, 0.0, 0.3)

MOTION: dict[str, Read] = {
    "legs": partial(one_of, ("smooth", "steady", "straight")),
    "limit": Quantity(Type.SPEED, 0.01, 100.0),
    "acceleration": Quantity(Type.FLOAT, 0.0, 100.0),
    "jerk": Quantity(Type.FLOAT, 0.0, 1000.0),
    "airspeed": Quantity(Type.SPEED, 0.5, 100.0),
    "up": Quantity(Type.SPEED, 0.05, 30.0),
    "down": Quantity(Type.SPEED, 0.05, 30.0),
    "low": Quantity(Type.LENGTH, 0.0, 100.0),
    "touch_down": Quantity(Type.SPEED, 0.05, 30.0),
    "take_off": _OVERHEAD,
    "settles": _OVERHEAD,
    "landing": _OVERHEAD,
    "pace": _FACTOR,
    "drain": _FACTOR,
    "spread": _SPREAD,
    "action_spread": _SPREAD,
    "taper": Quantity(Type.PERCENT, 0.0, 0.5),
}
"""How the keys of a fleet's `[motion]` are read."""


def each(read: Read, what: str, counts: Collection[int], value: object) -> tuple[Any, ...]:
    """Read a list; of one of these lengths, if any are given."""
    if not isinstance(value, list) or (counts and len(value) not in counts):
        several = " or ".join(map(str, counts)) or "several"
        raise ValueError(f"is not a list of {several} {what}s")
    found = []
    for number, element in enumerate(value, 1):
        try:
            found.append(read(element))
        except ValueError as error:
            raise ValueError(f"is wrong at {what} {number}, which {error}") from None
    return tuple(found)


size: Read = partial(each, SIDE, "number", (2,))
corner: Read = partial(each, PLACE, "number", (2,))
point: Read = partial(each, PLACE, "number", (2, 3))


def point_on(airspace: Airspace | None, height: float, read: Read, value: object) -> Point:
    """Read a point of a map, at this height if it has none; None: of any map."""
    x, y, z = [*read(value), height][:3]
    if airspace is not None and (problem := airspace.problem((x, y, z))):
        raise ValueError(problem.removeprefix(f"{place((x, y))} "))
    return x, y, z


def polygon(value: object) -> tuple[Corner, ...]:
    """Read the corners of an area."""
    corners = each(corner, "corner", (), value)
    if not covers_ground(corners):
        raise ValueError("covers no ground: an area has three corners [x, y], not on one line")
    return corners


areas: Read = partial(each, polygon, "area", ())

READERS: dict[FieldType | Type, Read] = {
    Type.INT: integer,
    Type.FLOAT: real,
    Type.BOOL: boolean,
    Type.TEXT: text,
    **{kind: Quantity(kind) for kind in QUANTITIES},
    FieldType.TIME: TIME,
    FieldType.INT: integer,
    FieldType.ROUNDS: rounds,
    FieldType.TIME_OF_DAY: time_of_day,
}
"""How parameters of actions, and fields of missions and trips, are read."""

KeyPath = tuple[str | int, ...]
"""`mission[2].trip[0].target` is `("mission", 2, "trip", 0, "target")`."""
Keys = Mapping[str, Read | None]
"""How each key is read; None: elsewhere, or only by the library."""

MOST_TOLD = 50  # problems


class Problem(NamedTuple):
    """Something that is wrong with what was written."""

    path: KeyPath
    who: str  # the subject of its sentence
    text: str
    is_missing: bool = False  # something is needed there, and nothing is there

    @property
    def sentence(self) -> str:
        """All of it, for people."""
        return f"{self.who}: {self.text}" if self.who else self.text


def shortened(lines: Sequence[str]) -> str:
    """Join lines, up to a number that can be read."""
    more = len(lines) - MOST_TOLD
    rest = [f"… and {more} more problem{'s' * (more > 1)}"] if more > 0 else []
    return "\n".join([*lines[:MOST_TOLD], *rest])


class Table:
    """One table, the path to it, and what messages call it."""

    point: Read = staticmethod(point)
    """Reads a place, which has a name in the library."""

    def __init__(self, data: Mapping[str, Any], path: KeyPath = (), who: str = "") -> None:
        self.data, self.path, self.who = data, path, who
        self.problems: list[Problem] = []  # of all tables of what was written

    def problem(self, text: str, *inside: str | int, is_missing: bool = False) -> None:
        """Note a problem of this table, or of something in it."""
        self.problems.append(Problem((*self.path, *inside), self.who, text, is_missing))

    def refuse_if_bad(self, name: str) -> None:
        """Raise `BadInput` with a line for each problem of a file, if there is one."""
        if self.problems:
            raise BadInput(shortened([f"{name}: {one.sentence}" for one in self.problems]))

    def read(
        self, needed: Keys, others: Keys | None = None, hints: Mapping[str, str] | None = None
    ) -> dict[str, Any]:
        """Return what stands under the keys that are needed, and under others that are there.

        `hints` say what to write under some that are needed.
        """
        keys = {**needed, **(others or {})}
        for key in self.data:
            if key not in keys:
                self.unknown(key, keys)
        for key in needed:
            if key not in self.data:
                self.problem(f"has no {key}{(hints or {}).get(key, '')}", key, is_missing=True)
        found = {key: self.value(key, read) for key, read in keys.items() if read}
        return {key: one for key, one in found.items() if key in needed or one is not None}

    def unknown(self, key: str, keys: Keys) -> None:
        """Note a key that is none of these."""
        self.problem(f"unknown key {quoted(key)}; there may be: {', '.join(keys) or 'none'}", key)

    def value(self, key: str, read: Read) -> Any:
        """Return what stands under a key; None if nothing does that can be read."""
        if key not in self.data:
            return None
        try:
            return read(self.data[key])
        except ValueError as error:
            self.problem(f"{key} {shown(self.data[key])} {error}", key)
            return None

    def differs(self, key: str, name: str | None, what: str, others: dict[str, Table]) -> None:
        """Note a name that another table has."""
        other = others.setdefault(name or "", self)
        if name and other is not self:
            said = f"there is another {what} {quoted(name)}{other.where(key)}: names must differ"
            self.problem(said, key)

    def where(self, key: str) -> str:
        """Say where a key is, as a message continues; the library knows it."""
        return ""

    def table(self, key: str) -> Self:
        """Return the table under a key, an empty one if there is none."""
        given = self.data.get(key, {})
        if not isinstance(given, dict):
            self.problem(f"{key} is not a table: write [{self._header(key)}]", key)
            given = {}
        return self._inner(given, key, who=f"{self.who}, {key}" if self.who else f"[{key}]")

    def tables(self, key: str, name: str = "name", *, needed: bool = False) -> Iterator[Self]:
        """Yield the tables of a list of them; each is called by its name, or by its number."""
        given, header = self.data.get(key, []), f"[[{self._header(key)}]]"
        if not isinstance(given, list) or not all(isinstance(one, dict) for one in given):
            said = f"{key} is not a list of tables: write {header}, with two brackets"
            self.problem(said, key)
            return
        if needed and not given:
            self.problem(f"has no {header}", is_missing=True)
        what = f"{self.who}, {key}" if self.who else key
        for index, one in enumerate(given):
            called = quoted(one[name]) if is_name(one.get(name)) else index + 1
            yield self._inner(one, key, index, who=f"{what.removesuffix('s')} {called}")

    def _header(self, key: str) -> str:
        return ".".join(part for part in (*self.path, key) if isinstance(part, str))

    def _inner(self, data: Mapping[str, Any], *inside: str | int, who: str) -> Self:
        inner = object.__new__(type(self))
        inner.__dict__.update(self.__dict__, data=data, path=(*self.path, *inside), who=who)
        return inner


def read_parameters(table: Table, parameters: Iterable[Parameter]) -> dict[str, Any]:
    """Return the parameters that are given, of an action for instance, defaults included."""
    defaults = {one.name: one.default for one in parameters if one.default is not None}
    readers = {one.name: READERS[one.type] for one in parameters}
    needed = {name: read for name, read in readers.items() if name not in defaults}
    return {**defaults, **table.read(needed, readers)}
