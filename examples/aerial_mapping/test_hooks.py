"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py aerial_mapping/tests/"""

from __future__ import annotations

from aerial_mapping import Mission, Photo, Trip, hooks
from aerial_mapping.testing import Kit


def photo(trip: Trip, *, off: float = 0.0, sharpness: float = 1.0) -> Photo:
    x, y, z = trip.target
    return Photo(position=(x + off, y, z), width=4.0, height=3.0, sharpness=sharpness)


def strip(kit: Kit) -> Mission:
    """Return a mission with two photos of one strip, which have enough in common."""
    return kit.mission(*(kit.trip("take_photo", target=(x, 5.0, 3.0)) for x in (4.0, 5.5)))


def test_photos_that_fit_are_a_map(kit: Kit) -> None:
    mission = strip(kit)
    for trip in tuple(mission.trips):
        kit.complete(mission, photo(trip))
    verdict = hooks.stitches(mission, kit.results(mission))
    assert verdict.ok and verdict.redo == ()
    assert verdict.log == ("2 photos fit the map",)


def test_a_blurred_photo_is_taken_again(kit: Kit) -> None:
    mission = strip(kit)
    one, other = mission.trips
    kit.complete(mission, photo(one, sharpness=0.4))
    kit.complete(mission, photo(other))
    verdict = hooks.stitches(mission, kit.results(mission))
    assert verdict.redo == (one,)
    assert verdict.log == ("photo trip 1 blurred: it is taken again",)


def test_of_two_too_far_apart_the_one_off_its_place_is_taken_again(kit: Kit) -> None:
    mission = strip(kit)
    one, other = mission.trips
    kit.complete(mission, photo(one))
    kit.complete(mission, photo(other, off=1.5))
    assert hooks.stitches(mission, kit.results(mission)).redo == (other,)


def test_a_mission_leaves_the_photos_of_others_alone(kit: Kit) -> None:
    mission, other = strip(kit), strip(kit)
    for trip in tuple(other.trips):
        kit.complete(other, photo(trip, sharpness=0.4))
    for trip in tuple(mission.trips):
        kit.complete(mission, photo(trip))
    assert hooks.stitches(mission, kit.results(mission)).redo == ()


def test_after_six_tries_the_mission_gives_up(kit: Kit) -> None:
    trip = kit.trip("take_photo")
    mission = kit.mission(trip)
    for _ in range(hooks.TRIES):
        mission.trips = [trip]
        kit.complete(mission, photo(trip, sharpness=0.4))
    assert hooks.stitches(mission, kit.results(mission)).fail == (
        "photo trip 1 still blurred after 6 tries"
    )
