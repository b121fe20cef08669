"""What the brain in command is told of each command that a drone has flown."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from pluto_fleet.jobs.flown import Flown
from pluto_fleet.shared.domain.errors import Failure
from tests.library.gateway.flights import THERE, Commander, Field, Task
from tests.library.simulation.flights import failure, fly

HOME = [1, 1, 0.0]
ABOVE = [1, 1, 1.2]


def measured() -> tuple[Field, Commander, list[Flown]]:
    """Return drones whose commands are measured, their link, and the list of what is told."""
    field = Field(measures=True)
    link = field.link(1)
    return field, link, link.flown


def facts(told: Sequence[Flown], *names: str) -> list[tuple[object, ...]]:
    return [tuple(one[name] for name in names) for one in told]


def test_each_command_of_a_job_is_told_with_its_seconds_and_its_battery() -> None:
    field, link, told = measured()
    link.fly(Task(), lambda _: None)
    field.advance(100)
    fly(field.kernel, link.land("cf1"))
    there, below = list(THERE), [*THERE[:2], 0.0]
    assert facts(told, "what", "from", "to", "ended") == [
        ("take_off", HOME, ABOVE, "done"),
        ("leg", ABOVE, there, "done"),
        ("action", there, there, "done"),
        ("land", there, below, "done"),
    ]
    assert facts(told, "drone", "category", "speed") == [("cf1", "scout", 0.5)] * 4
    assert [one["seconds"] for one in told[:2]] == pytest.approx([4.0, 10.0])
    assert told[1]["battery"] == pytest.approx([1 - 4 / 420, 1 - 14 / 420], abs=1e-5)
    assert told[2]["action"] == "pick_item"
    assert facts(told[:1], "flight_time", "charge_time") == [(420, 1200)]


def test_what_is_broken_off_or_fails_is_told_as_that() -> None:
    field, link, told = measured()
    link.fly(Task(id="a"), lambda _: None)
    link.fly(Task(id="b", drone="cf2", stops=((12.0, 1.0, 1.2),)), lambda _: None)
    field.advance(6)
    link.break_off("cf1")
    field.navigation.strike("cf2", Failure.CRASH)
    field.advance(1)
    ends = {(one["drone"], one["what"]): (one["ended"], one["seconds"]) for one in told}
    assert ends["cf1", "leg"] == ("broken off", pytest.approx(2.0))
    assert ends["cf2", "leg"] == ("failed", pytest.approx(2.0))


def test_a_command_that_moves_nothing_is_no_measurement() -> None:
    field, link, told = measured()
    assert failure(field.kernel, link.hold("cf1")).failure is Failure.REFUSED
    fly(field.kernel, link.land("cf1"))
    assert told == []


def test_only_the_brain_in_command_is_told_and_it_need_not_listen() -> None:
    field, old, told = measured()
    old.fly(Task(), lambda _: None)
    field.advance(5)
    new = field.gateway.link(2)
    field.advance(10)
    later = Commander(new).flown
    field.advance(100)
    assert [one["what"] for one in told] == ["take_off"]
    assert [one["what"] for one in later] == ["action"]
