"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py pm10/tests/"""

from __future__ import annotations

from pm10 import Mission, hooks
from pm10.testing import Kit


def sampled(kit: Kit, *samples: tuple[float, float], reach: float = 3.2) -> Mission:
    """Return a mission along a line that has measured values at these places."""
    trips = [kit.trip("measure", target=(x, 0.0, 1.5)) for x, _ in samples]
    mission = kit.mission(*trips, reach=reach)
    for _, value in samples:
        kit.complete(mission, value)
    return mission


def test_one_more_sample_is_taken_where_the_dust_changes(kit: Kit) -> None:
    mission = sampled(kit, (0.0, 10.0), (3.0, 40.0), (6.0, 42.0))
    verdict = hooks.follow_gradients(mission, kit.results(mission))
    assert [trip.target for trip in verdict.add] == [(1.5, 0.0, 1.5)]
    assert [trip.parameters for trip in verdict.add] == [{"quantity": "pm10"}]
    assert verdict.log == ("gradient 1.5/0/1.5: 10.0 µg/m³ a metre",)


def test_where_the_dust_is_even_nothing_is_added(kit: Kit) -> None:
    mission = sampled(kit, (0.0, 10.0), (3.0, 12.0))
    verdict = hooks.follow_gradients(mission, kit.results(mission))
    assert verdict.add == () and verdict.log == ("fine enough; highest so far: 12 µg/m³",)


def test_a_gradient_is_left_to_missions_that_have_a_share_in_it(kit: Kit) -> None:
    sampled(kit, (0.0, 10.0), (3.0, 40.0))
    far = sampled(kit, (12.0, 10.0))
    assert hooks.follow_gradients(far, kit.results(far)).add == ()


def test_a_mission_adds_four_trips_at_most(kit: Kit) -> None:
    mission = sampled(kit, (0.0, 10.0), (3.0, 40.0), (6.0, 10.0), (9.0, 40.0))
    assert len(hooks.follow_gradients(mission, kit.results(mission)).add) == hooks.AT_ONCE
    for trip in mission.completed_trips[:3]:
        trip.added = True
    assert len(hooks.follow_gradients(mission, kit.results(mission)).add) == 1


def test_with_a_larger_reach_it_looks_farther_and_less_closely(kit: Kit) -> None:
    mission = sampled(kit, (0.0, 10.0), (40.0, 30.0), (50.0, 40.0), reach=45.0)
    verdict = hooks.follow_gradients(mission, kit.results(mission))
    assert [trip.target for trip in verdict.add] == [(20.0, 0.0, 1.5)]
    assert verdict.log == ("gradient 20/0/1.5: 0.5 µg/m³ a metre",)
