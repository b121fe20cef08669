"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py object_finder/tests/"""

from __future__ import annotations

import pytest
from object_finder import Mission, Photo, Trip, hooks
from object_finder.testing import Clock, Kit, KitContext


def photo(trip: Trip, *sees: str, sharpness: float = 1.0) -> Photo:
    return Photo(position=trip.target, width=2.0, height=1.5, sees=sees, sharpness=sharpness)


@pytest.fixture
def mission(kit: Kit) -> Mission:
    """Return a mission that looks for the keys in two places."""
    kitchen = [kit.trip("take_photo", name=name) for name in ("table", "sink")]
    return kit.mission(*kitchen, name="keys: kitchen")


def test_a_fetcher_needs_a_while(kit: Kit, clock: Clock, context: KitContext) -> None:
    drone, trip = kit.drone("fetcher"), kit.trip("bring_back", parameters={"thing": "keys"})
    call = kit.start(hooks.bring_back, drone, trip, context, thing="keys")
    clock.advance(hooks.GRIP_SECONDS)
    assert call.result() == "keys"
    assert context.lines == ["fetcher 1 brings the keys home"]


def test_the_sharpest_sight_is_fetched_from(kit: Kit, mission: Mission) -> None:
    kit.complete(mission, photo(mission.current, "keys", sharpness=0.8))
    kit.complete(mission, photo(mission.current, "keys", "cup", sharpness=0.9))
    verdict = hooks.who_saw_it(mission, kit.results(mission))
    assert [trip.parameters for trip in verdict.add] == [{"thing": "keys"}]
    assert verdict.log == ("keys seen: sink",)


def test_a_blurred_photo_is_taken_three_times_at_most(kit: Kit, mission: Mission) -> None:
    table, sink = mission.trips
    kit.complete(mission, photo(table, "cup"))
    for _ in range(2):
        kit.complete(mission, photo(sink, sharpness=0.5))
        assert hooks.who_saw_it(mission, kit.results(mission)).redo == (sink,)
        mission.trips.append(sink)
    kit.complete(mission, photo(sink, sharpness=0.5))
    assert sink.attempt == 3
    assert hooks.who_saw_it(mission, kit.results(mission)).log == ("keys not found here",)


def test_what_is_brought_is_not_sought_again(kit: Kit, mission: Mission) -> None:
    mission.trips = [kit.trip("bring_back", parameters={"thing": "keys"})]
    kit.complete(mission, "keys")
    assert hooks.who_saw_it(mission, kit.results(mission)).log == ("keys brought back",)
