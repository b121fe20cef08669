"""MissionRepeater: a finished mission begins again with the user's own trips, as often as was asked."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.shared.domain.model import Mission, Results
from pluto_fleet.shared.hooks.context import Verdict
from tests.kit import apps
from tests.kit.living import Living


def repeated(repeat: int | bool, *trips: apps.Trip, **how: Any) -> apps.SimulationResult:
    """Fly a mission of these trips."""
    return apps.flown(apps.mission("m", *trips, repeat=repeat), repeater=True, **how)


@pytest.mark.parametrize("more", [0, 1, 3])
def test_so_many_rounds_are_flown_after_the_first(more: int) -> None:
    outcome = repeated(more, apps.trip("A", 2.0), apps.trip("B", 3.0))
    flown = [(e["round"], e["trip"], e["attempt"]) for e in apps.events(outcome, "trip.launched")]
    assert flown == [(n, name, 1) for n in range(more + 1) for name in "AB"]
    assert (outcome.completed, outcome.missions[0].round) == (True, more)


def test_true_is_until_it_is_stopped() -> None:
    outcome = repeated(True, apps.trip("A", 2.0), until=300.0)
    assert outcome.count("mission.repeated") > 10
    assert not outcome.completed


def test_trips_come_back_in_the_order_of_the_plan_though_they_were_flown_in_another() -> None:
    def turn(mission: Mission[apps.Trip], context: object) -> None:
        if mission.round == 0 and len(mission.trips) == 3:
            mission.trips.reverse()

    trips = [apps.trip(name, 2.0) for name in "ABC"]
    outcome = repeated(1, *trips, prepare=turn)
    assert [e["trip"] for e in apps.events(outcome, "trip.launched")] == [*"CBAABC"]


def test_an_attempt_of_an_earlier_round_does_not_count_in_the_next() -> None:
    """A trip that was flown twice in one round is flown for the first time in the next."""

    def once_more(mission: Mission[apps.Trip], results: Results[Any, Any]) -> Verdict:
        again = mission.round == 0 and mission.attempts == 1
        return Verdict(redo=tuple(mission.completed_trips) if again else ())

    outcome = repeated(1, apps.trip("A", 2.0), evaluator=once_more)
    launched = [(e["round"], e["attempt"]) for e in apps.events(outcome, "trip.launched")]
    assert launched == [(0, 1), (0, 2), (1, 1)]
    assert outcome.completed


def test_what_an_evaluator_beside_it_sends_back_counts_anew_in_the_next_round_too() -> None:
    app = apps.loaded(FORKED, HOOKS).app
    trip = app.trip(name="A", action="take_photo", target=(2.0, 0.5, 1.2))
    mission: Any = app.mission(name="m", trips=[trip])
    mission.repeat = 1
    living = Living(app, mission, on=apps.TWO)
    living.crash(9.0)  # it goes on from its journal
    assert living.run() == ["COMPLETED"]
    for kind in ("trip.launched", "trip.completed"):
        events = [one for one in living.events if one["event"] == kind]
        assert [(one["round"], one["attempt"]) for one in events] == [(0, 1), (1, 1)]


FORKED = """pluto 1
app NAME {
  category scout can take_photo
  evaluator once_more
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  judge = MissionEvaluator(hook: once_more)
  again = MissionRepeater
  all = GateFunnel
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> [judge, again] when COMPLETED
  [judge, again] -> all
  all -> allocate when STANDBY
  [watch, all] -> end otherwise
}"""
HOOKS = """
from . import Verdict

def once_more(mission, results):
    return Verdict(redo=mission.completed_trips if mission.round == 0 else ())
"""
