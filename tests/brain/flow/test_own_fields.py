"""An app with fields of its own, evaluators with parameters and actions that say what they give, flown."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan
from typing import Any

import numpy as np
import pytest

from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import parsed
from pluto_fleet.shared.domain.airspace import Airspace
from tests.kit import apps
from tests.kit.living import Living

SOURCE = """pluto 1

app NAME "Wards" {
  mission has patient: text, margin: time = 10 min
  trip has note: text = "", layers: int, gentle: bool = yes
  action spray(dose: mass = 50 mg) -> float safe
  action look -> photo safe
  evaluator strict(least: int = 2, share: percent = 50 %)
  evaluator lenient(most: int = 7)
  modifier count_layers(by: int = 1) writes patient

  create = MissionCreator
  wait = Clock
  count = MissionModifier(hook: count_layers)
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: strict, least: 3)
  retry = PriorityManager

  start -> create -> wait -> count -> allocate -> launch -> watch
  watch -> wait when STANDBY
  watch -> retry when FAILED
  watch -> judge when COMPLETED
  [retry, judge] -> wait when STANDBY
  [retry, judge] -> end otherwise
}
"""
HOOKS = """from . import Context, Drone, Mission, Photo, Results, Status, Trip, Verdict

CALLS: list[tuple[object, ...]] = []


async def spray(drone: Drone, trip: Trip, context: Context, *, dose: float) -> float:
    await context.sleep(2.0)
    trip.note += "!"
    return dose


def look(drone: Drone, trip: Trip, context: Context) -> Photo:
    return Photo(position=trip.target, width=1.0, height=1.0)


def strict(mission: Mission, results: Results, *, least: int, share: float) -> Verdict:
    CALLS.append(("strict", least, share, mission.patient, mission.margin))
    values = [one.value for one in results.new]
    CALLS.append(("gave", *values))
    return Verdict(log=[f"{mission.patient}: {one.note} {one.layers}" for one in mission.completed_trips])


def lenient(mission: Mission, results: Results, *, most: int) -> Verdict:
    CALLS.append(("lenient", most))
    return Verdict()


def count_layers(mission: Mission, context: Context, *, by: int) -> None:
    mission.current.layers += by
    mission.patient = mission.patient.upper()
"""
TRIP = '[[mission.trip]]\naction = "{action}"\ntarget = [{x}, 3]\nlayers = {layers}\n'
PLAN = '[[mission]]\nname = "one"\npatient = "Ada"\n' + "".join(
    TRIP.format(action=action, x=x, layers=x)
    for x, action in enumerate(("spray", "look", "measure"), 1)
)


def missions(made: apps.Loaded, text: str = PLAN) -> list[Any]:
    """Read a missions file."""
    return missions_of(parsed("missions.toml", text), made.app, Airspace())


def fly(made: apps.Loaded, text: str = PLAN, *, spray: Any = None) -> Any:
    """Simulate a plan of one mission, perhaps with another action."""
    made.hooks.CALLS.clear()
    given: Any = made.app.given
    own = {"spray": replace(given.actions["spray"], hook=spray)} if spray else {}
    app = apps.changed(made.app, actions={**given.actions, **own})
    return apps.fly(app, *missions(made, text), on=default_fleet(app), seed=1).missions[0]


@pytest.fixture
def wards() -> apps.Loaded:
    """The app of these tests."""
    return apps.loaded(SOURCE, HOOKS)


def test_hooks_read_and_write_them(wards: apps.Loaded) -> None:
    """In SI units; what is left out has its default."""
    mission = fly(wards)
    assert (mission.status.value, mission.reason) == ("COMPLETED", "")
    assert wards.hooks.CALLS[0] == ("strict", 3, 0.5, "ADA", 600.0)
    said, dose, photo, measured = wards.hooks.CALLS[1]
    assert (said, dose, type(photo).__name__, type(measured)) == ("gave", 5e-05, "Photo", float)
    trips = mission.completed_trips
    assert [(one.note, one.layers, one.gentle) for one in trips] == [
        ("!", 2, True),
        ("", 3, True),
        ("", 4, True),
    ]
    assert (mission.patient, mission.margin) == ("ADA", 600.0)


@pytest.mark.parametrize(
    ("chosen", "calls"),
    [
        ("", ("strict", 3, 0.5)),
        ('evaluator = "strict"', ("strict", 3, 0.5)),
        ('evaluator = "lenient"', ("lenient", 7)),
    ],
)
def test_the_blocks_settings_are_for_its_own_evaluator(
    wards: apps.Loaded, chosen: str, calls: tuple[object, ...]
) -> None:
    fly(wards, PLAN.replace('patient = "Ada"', f'patient = "Ada"\n{chosen}'))
    assert wards.hooks.CALLS[0][: len(calls)] == calls


class Fancy(float):
    """A number of another class."""


class Index:
    """What Python takes for a whole number."""

    def __index__(self) -> int:
        return 3


@pytest.mark.parametrize(
    ("value", "kept"),
    [
        (0.5, 0.5),
        (3, 3.0),
        (Fancy(2.5), 2.5),
        (Index(), 3.0),
        (10**18, 1e18),
        (np.float32(0.5), 0.5),
    ],
)
def test_a_number_is_kept_as_one(wards: apps.Loaded, value: object, kept: float) -> None:
    mission = fly(wards, spray=lambda drone, trip, context, dose: value)
    assert mission.status.value == "COMPLETED"
    given = wards.hooks.CALLS[1][1]
    assert (type(given), given) == (float, kept)


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (None, "not None"),
        (True, "not True, which is bool"),
        ("5 mg", "not '5 mg', which is str"),
        ([1.0], "not [1.0], which is list"),
        (10**400, "not 1000"),
        (np.True_, "not np.True_, which is bool"),
        *((odd, f"not {odd!r}, which is not finite") for odd in (nan, inf, np.float16(inf))),
    ],
)
def test_a_value_of_another_type_fails_the_mission(
    wards: apps.Loaded, value: object, said: str
) -> None:
    """As a fault of the hook: no other flight would mend it."""
    mission = fly(wards, spray=lambda drone, trip, context, dose: value)
    assert mission.status.value == "FAILED"
    assert mission.reason.startswith(f"hook spray must return a number, {said}")
    assert mission.attempts == 1


@pytest.mark.parametrize(
    ("field", "value", "said"),
    [
        ("note", None, "note must be a text, not None"),
        ("note", b"x", "note must be a text, not b'x'"),
        ("layers", 1.5, "layers must be a whole number, not 1.5"),
        ("layers", True, "layers must be a whole number, not True"),
        ("gentle", np.int8(1), "gentle must be True or False, not np.int8(1)"),
        ("layers", np.True_, "layers must be a whole number, not np.True_"),
        ("gentle", 1, "gentle must be True or False, not 1"),
    ],
)
def test_a_wrong_value_that_an_action_leaves_is_told(
    wards: apps.Loaded, field: str, value: object, said: str
) -> None:
    def spray(drone: Any, trip: Any, context: Any, *, dose: float) -> float:
        setattr(trip, field, value)
        return dose

    mission = fly(wards, spray=spray)
    assert mission.reason == f"hook spray raised TypeError: trip.{said}"


def test_another_librarys_values_are_plain_from_then_on(wards: apps.Loaded) -> None:
    """In results, fields and parameters: what is kept of them is what was given."""

    def spray(drone: Any, trip: Any, context: Any, *, dose: float) -> object:
        trip.gentle = np.False_
        trip.layers = np.int64(7)
        trip.note = np.str_("hm")
        return np.bool_(True)

    given: Any = wards.app.given
    own = replace(given.actions["spray"], hook=spray, returns=bool)
    app = apps.changed(wards.app, actions={**given.actions, "spray": own})
    life = Living(app, *missions(wards), on=default_fleet(app))
    life.crash(30.0)
    wards.hooks.CALLS.clear()
    assert life.run() == ["COMPLETED"]
    trip: Any = life.life.missions[0].completed_trips[0]
    assert repr((trip.gentle, trip.layers, trip.note)) == "(False, 7, 'hm')"
    assert wards.hooks.CALLS[1][1] is True


@pytest.mark.parametrize("when", [0.5, 15.0, 40.0])
def test_they_survive_a_crash_and_a_stop(wards: apps.Loaded, when: float) -> None:
    """At any time, as their hooks have left them."""
    for end in ("crash", "stop"):
        life = Living(wards.app, *missions(wards), on=default_fleet(wards.app))
        getattr(life, end)(when)
        assert life.run() == ["COMPLETED"]
        mission: Any = life.life.missions[0]
        assert (mission.patient, mission.margin) == ("ADA", 600.0)
        assert [one.layers for one in mission.completed_trips][1:] == [3, 4]
        assert all(one.gentle is True for one in mission.completed_trips)


def test_a_new_trip_with_a_wrong_value_is_told_of_its_evaluator() -> None:
    """And one without what must be filled in cannot be made."""
    for more, said in (
        (
            "layers=1.5",
            "evaluator strict adds a trip that cannot be flown: trip b: layers must be a whole number",
        ),
        (
            "note=''",
            "hook strict raised TypeError: Trip.__init__() missing 1 required keyword-only",
        ),
    ):
        made_of = f'Trip(name="b", action="measure", target=(1, 2, 1), {more})'
        hooks = HOOKS.replace(
            "    values = [", f"    return Verdict(add=[{made_of}])\n    values = ["
        )
        assert fly(apps.loaded(SOURCE, hooks)).reason.startswith(said)
