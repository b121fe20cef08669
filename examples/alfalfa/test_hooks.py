"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py alfalfa/tests/"""

from __future__ import annotations

import pytest
from alfalfa import ActionFailed, Mission, Photo, Trip, hooks
from alfalfa.testing import Clock, Kit, KitContext


def photo(trip: Trip, *sees: str) -> Photo:
    return Photo(position=trip.target, width=2.0, height=1.5, sees=sees)


def test_a_carrier_hovers_until_the_dose_is_shed(
    kit: Kit, clock: Clock, context: KitContext
) -> None:
    trip = kit.trip("pollinate", target=(2.0, 3.0, 1.0))
    call = kit.start(hooks.pollinate, kit.drone("carrier"), trip, context, dose=50e-6)
    clock.advance(4.9)
    assert not call.done
    clock.advance(0.1)
    assert call.result() == 50e-6
    assert context.lines == ["carrier 1 pollinated (2.0, 3.0) with 50 mg"]


def test_a_dose_that_no_carrier_takes_along_is_refused(kit: Kit, context: KitContext) -> None:
    with pytest.raises(ActionFailed, match="300 mg is more than carrier 1 takes along"):
        kit.call(hooks.pollinate, kit.drone("carrier"), kit.trip("pollinate"), context, dose=300e-6)


def test_what_blooms_is_pollinated_once(kit: Kit, mission: Mission) -> None:
    kit.complete(mission, photo(mission.current, "bloom", "bloom"))
    (added,) = hooks.find_blooms(mission, kit.results(mission)).add
    assert (added.action, added.target) == ("pollinate", mission.current.target)
    assert added.parameters == {"dose": 40e-6}
    kit.complete(kit.mission(kit.trip("pollinate", target=added.target)), 40e-6)
    other = kit.mission(kit.trip("take_photo", target=added.target))
    kit.complete(other, photo(other.current, "bloom"))
    assert hooks.find_blooms(other, kit.results(other)).add == ()


def test_the_farmer_is_told_of_sick_plants(kit: Kit, mission: Mission) -> None:
    kit.complete(mission, photo(mission.current, "pest"))
    verdict = hooks.find_blooms(mission, kit.results(mission))
    assert verdict.log == ("WARNING: pest at (3.0, 4.0)",)
    assert verdict.ok and not verdict.add
