"""Frozen values: what dataclasses promise, and that nobody changes them."""

from __future__ import annotations

import copy
from dataclasses import FrozenInstanceError, dataclass, field, fields, replace
from typing import Any, cast

import pytest

from plutoc.frozen import filled, frozen, frozen_one


@frozen
class Leg:
    """A value."""

    start: str
    end: str = "home"

    def turned(self) -> Leg:
        """Slots and methods go together."""
        return Leg(start=self.end, end=self.start)


@frozen
class Way:
    """Another one, of the same fields."""

    start: str
    end: str = "home"


@dataclass(frozen=True, slots=True, kw_only=True)
class Standard:
    """The library's own."""

    start: str
    end: str = "home"


@frozen
class Nothing:
    """One without fields."""


@frozen_one
class Drone:
    """Nobody's like."""

    name: str
    routes: dict[str, Leg] = field(default_factory=dict)


def test_one_is_equal_to_itself_only() -> None:
    """Whatever it holds: so it can be a key, too."""
    one, other = Drone(name="a"), Drone(name="a")
    assert one != other
    assert len({one, other}) == 2


def test_each_one_gets_a_default_of_its_own() -> None:
    """Where a function makes it."""
    one, other = Drone(name="a"), Drone(name="b")
    assert one.routes == {} and one.routes is not other.routes
    assert replace(one, name="c").routes is one.routes


def test_nobody_changes_one() -> None:
    one: Any = Drone(name="a")
    with pytest.raises(FrozenInstanceError, match="its name stays as it is"):
        one.name = "b"
    with pytest.raises(TypeError, match="Drone needs 'name'"):
        cast(Any, Drone)()


@filled
class Log:
    """Grows."""

    drone: str
    lines: list[str] = field(default_factory=list)
    closed: bool = False


def test_a_record_is_filled() -> None:
    """Each has lists of its own, and is equal to itself only."""
    one, other = Log(drone="a"), Log(drone="a", closed=True)
    one.lines.append("took off")
    one.closed = True
    assert (one.drone, one.lines, one.closed) == ("a", ["took off"], True)
    assert other.lines == []
    assert one != Log(drone="a", lines=["took off"], closed=True)


def test_a_record_has_no_other_fields() -> None:
    log: Any = Log(drone="a")
    with pytest.raises(AttributeError):
        log.drones = ["a"]
    with pytest.raises(TypeError, match="Log has no "):
        cast(Any, Log)(drone="a", pilot="b")


def test_a_value_is_equal_to_its_like_and_to_nothing_else() -> None:
    assert Leg(start="a") == Leg(start="a", end="home")
    assert Leg(start="a") != Leg(start="b")
    assert cast(object, Leg(start="a")) != Way(start="a")
    assert Nothing() == Nothing()


def test_equal_values_are_one_key() -> None:
    assert len({Leg(start="a"), Leg(start="a", end="home"), Leg(start="b")}) == 2
    assert len({Nothing(), Nothing()}) == 1


def test_nobody_changes_a_value() -> None:
    leg: Any = Leg(start="a")
    with pytest.raises(FrozenInstanceError, match="its start stays as it is"):
        leg.start = "b"
    with pytest.raises(FrozenInstanceError):
        del leg.start
    with pytest.raises(FrozenInstanceError):
        leg.other = "b"
    assert not hasattr(leg, "__dict__")


def test_a_wrong_field_is_refused() -> None:
    make: Any = Leg
    for given in (
        {},
        {"end": "b"},
        {"start": "a", "stop": "b"},
        {"start": "a", "end": "b", "x": 1},
    ):
        with pytest.raises(TypeError):
            make(**given)
    with pytest.raises(TypeError):
        make("a")


def test_the_library_treats_it_as_a_dataclass() -> None:
    leg = Leg(start="a")
    assert replace(leg, start="b") == Leg(start="b")
    assert [field.name for field in fields(leg)] == ["start", "end"]
    assert copy.copy(leg) == leg == copy.deepcopy(leg)
    assert leg.turned() == Leg(start="home", end="a")
    assert repr(leg) == repr(Standard(start="a")).replace("Standard", "Leg")
