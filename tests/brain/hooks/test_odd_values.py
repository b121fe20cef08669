"""Hooks give, and leave behind, values of any kind: none of them stops anything but its mission."""

from __future__ import annotations

import json
from collections.abc import Callable
from enum import IntEnum
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.model import Mission, Photo
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.domain.text import LONGEST_VALUE, shown
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context, Verdict
from pluto_fleet.shared.hooks.plain_data import keepable, value_data, value_of
from tests.kit import apps
from tests.kit.living import Living, enterable


class Odd:
    """An object that cannot even say what it is."""

    def __repr__(self) -> str:
        raise ValueError

    __str__ = __len__ = __bool__ = __repr__


class Level(IntEnum):
    """A number with a name."""

    HIGH = 3


def round_list() -> list[Any]:
    value: list[Any] = []
    value.append(value)
    return value


def deep(depth: int = 100_000) -> list[Any]:
    value: list[Any] = []
    for _ in range(depth):
        value = [value]
    return value


def many() -> list[Any]:
    """The same few lists again and again: written out, more than there is room for."""
    value: list[Any] = ["ha"] * 10
    for _ in range(30):
        value = [value] * 10
    return value


ODD: dict[str, Callable[[], object]] = {
    "digits": lambda: 10**10_000,
    "digits in a list": lambda: [-(10**10_000)],
    "round list": round_list,
    "deep": deep,
    "deep enough to be written": lambda: deep(300),
    "many": many,
    "an object that refuses": Odd,
    "such objects in a list": lambda: [Odd()],
    "as keys": lambda: {1: 2, None: {3}, (4,): "x"},
    "reserved keys": lambda: {"$number": "none", "$photo": {}},
    "long": lambda: "x" * 5_000_000,
    "longer": lambda: ["x" * 5_000_000] * 3,
    "bytes": lambda: b"\xff" * 5_000_000,
    "lone surrogate": lambda: {"\udc80": "\ud800"},
    "control characters": lambda: "\x1b[2J\x00",
    "no numbers": lambda: [float("nan"), float("inf"), -0.0],
    "an enumeration": lambda: Level.HIGH,
    "a generator": lambda: (n for n in range(3)),
    "a set": lambda: {1, "a", frozenset()},
    "a photo of nothing": lambda: Photo(position=None, width="x", height=1j),  # type: ignore[arg-type]
    "a class": lambda: int,
    "a half photo": lambda: {"photo": Photo(position=(1, 2), width=0, height=0)},  # type: ignore[arg-type]
}


def lived(hook: Callable[..., object]) -> Mission[Any]:
    """Return a mission whose action this is; another one beside it is completed, on record."""

    def act(drone: Any, trip: Any, context: Context) -> object:
        return hook(trip) if trip.name == "odd" else 1

    tested = enterable(actions=[OwnAction(name="look", hook=act)])
    living = Living(
        tested,
        apps.mission("odd", apps.trip("odd", 3.0, action="look"), apps.trip("B", 4.0)),
        apps.mission("good", apps.trip("A", 9.0, action="look")),
        on=apps.TWO,
    )
    living.run()
    odd, good = living.life.missions
    assert good.status is Status.COMPLETED
    standing = living.memory.standing()
    json.dumps(standing.data)
    assert {name: one["status"] for name, one in standing.missions.items()} == {
        one.name: one.status.value for one in (odd, good)
    }
    return odd


@pytest.mark.parametrize("make", ODD.values(), ids=ODD)
def test_what_an_action_gives_or_fails_with_is_kept_as_far_as_it_can_be(
    make: Callable[[], object],
) -> None:
    """What it fails with is a reason of some length."""

    def fails(trip: Any) -> None:
        raise ActionFailed(make())

    assert lived(lambda trip: make()).status is Status.COMPLETED
    mission = lived(fails)
    assert mission.status is Status.FAILED
    assert 0 < len(mission.reason) < 4_000


@pytest.mark.parametrize("make", ODD.values(), ids=ODD)
def test_a_verdict_of_anything_fails_one_mission(make: Callable[[], Any]) -> None:
    def verdict(mission: Any, results: Any) -> Any:
        odd, kind = make(), mission.name
        return {
            "it": odd,
            "ok": Verdict(ok=odd),
            "fail": Verdict(fail=odd),
            "redo": Verdict(redo=(odd,)),
            "add": Verdict(add=(odd,)),
            "adds": Verdict(add=odd),
            "log": Verdict(log=(odd,), ok=False),
            "good": Verdict(),
        }[kind]

    names = ("it", "ok", "fail", "redo", "add", "adds", "log", "good")
    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in names]
    outcome = apps.flown(*missions, evaluator=verdict)
    ends = {mission.name: mission.status for mission in outcome.missions}
    assert ends.pop("good") is Status.COMPLETED
    assert {name for name, status in ends.items() if status is not Status.FAILED} <= {"ok", "adds"}
    assert all(len(mission.reason) < 4_000 for mission in outcome.missions)
    assert all(len(line) < 25_000 for line in outcome.log)


def test_an_action_that_fails_without_a_word_has_a_reason() -> None:
    def fails(trip: Any) -> None:
        raise ActionFailed

    assert lived(fails).reason == "look failed: it does not say why"


FACTS = ("name", "status", "reason", "round", "attempts", "index", "trips", "completed_trips")
TRIP_FACTS = ("name", "action", "target", "source", "parameters", "item", "status", "attempt")
FIELDS = ("every", "safe_time", "repeat")


def setting(mission: Any, fact: str, value: object) -> None:
    """Put a value into a mission, or into its trip, as a hook may."""
    where, _, name = fact.partition(".")
    setattr(mission if where == "mission" else mission.current, name, value)


PLACES = (
    *(f"mission.{fact}" for fact in (*FACTS, *FIELDS)),
    *(f"trip.{fact}" for fact in (*TRIP_FACTS, "delay", "priority")),
)


@pytest.mark.parametrize("place", PLACES)
def test_what_a_modifier_leaves_anywhere_fails_one_mission(place: str) -> None:
    """Or is harmless, as a number is in a field for numbers. A quarter of all odd values for each place."""
    for name, make in [*ODD.items()][PLACES.index(place) % 4 :: 4]:

        def leaves(mission: Any, context: Context, make: Callable[[], object] = make) -> None:
            if mission.name == "odd":
                setting(mission, place, make())

        living = Living(
            enterable(prepare=leaves),
            apps.mission("odd", apps.trip("A", 3.0)),
            apps.mission("good", apps.trip("A", 9.0)),
            on=apps.TWO,
        )
        living.run()
        odd, good = living.life.missions
        assert good.status is Status.COMPLETED, name
        assert odd.status in (Status.FAILED, Status.COMPLETED), name
        assert len(odd.reason) < 4_000, name


def test_of_a_field_that_a_block_cannot_go_by_the_name_is_told() -> None:
    def leaves(mission: Any, context: Context) -> None:
        mission.current.priority = [[...]]

    (mission,) = apps.flown(apps.mission("odd", apps.trip("A", 3.0)), prepare=leaves).missions
    assert "trip.priority must be a number, not [[Ellipsis]]" in mission.reason


values = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(st.characters(codec=None)),
        st.binary(max_size=8),
        st.sampled_from(sorted(ODD)).map(lambda name: ODD[name]()),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.tuples(inner, inner),
        st.dictionaries(st.one_of(st.text(max_size=3), st.integers()), inner, max_size=3),
    ),
    max_leaves=6,
)


@settings(max_examples=40, suppress_health_check=list(HealthCheck))
@given(values)
def test_any_value_can_be_written_and_read_again(value: object) -> None:
    """As it is, or as text; and what was read stays the same from then on."""
    read = value_of(json.loads(json.dumps(value_data(value))))
    written = json.dumps(value_data(read))
    assert json.dumps(value_data(value_of(json.loads(written)))) == written
    assert len(shown(value)) < LONGEST_VALUE + 100
    keepable(value)
