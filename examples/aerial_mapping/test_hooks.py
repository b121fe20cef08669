"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py aerial_mapping/tests/"""

from __future__ import annotations

from dataclasses import replace

from aerial_mapping import Mission, Photo, Result, Results, Trip, hooks
from aerial_mapping.testing import Kit


def photo(trip: Trip, *, off: float = 0.0, sharpness: float = 1.0) -> Photo:
    x, y, z = trip.target
    return Photo(position=(x + off, y, z), width=4.0, height=3.0, sharpness=sharpness)


def strip(kit: Kit) -> Mission:
    """Return a mission with two photos of one strip, which have enough in common."""
    return kit.mission(*(kit.trip("take_photo", target=(x, 5.0, 3.0)) for x in (4.0, 5.5)))


def line(kit: Kit, mission: Mission, *sharpness: float) -> Results:
    """Return the photos of a mission's line, one at each metre; the last of them at its end."""
    [trip] = mission.trips
    kit.complete(mission, photo(trip, sharpness=sharpness[-1]))
    on_the_way = [
        Result(mission, trip, 0, 1, photo(trip, off=number - 2.0, sharpness=sharp))
        for number, sharp in enumerate(sharpness[:-1])
    ]
    return Results(new=(), all=[*on_the_way, *kit.results(mission).all])


def along(kit: Kit) -> Mission:
    """Return a mission with a line, of which there are three photos."""
    trip = kit.trip(
        "take_photo",
        source=(4.0, 5.0, 3.0),
        target=(6.0, 5.0, 3.0),
        along={"action": "take_photo", "metres": 1.0},
    )
    return kit.mission(trip)


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
    mission = strip(kit)
    other = kit.mission(kit.trip("take_photo", target=(4.0, 7.0, 3.0)))
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


def test_photos_on_the_way_that_fit_are_a_map(kit: Kit) -> None:
    mission = along(kit)
    verdict = hooks.stitches(mission, line(kit, mission, 1.0, 1.0, 1.0))
    assert verdict.log == ("3 photos fit the map",)
    assert verdict.ok and not verdict.redo and not verdict.add


def test_a_blurred_photo_on_the_way_is_taken_again_alone(kit: Kit) -> None:
    mission = along(kit)
    verdict = hooks.stitches(mission, line(kit, mission, 1.0, 0.4, 1.0))
    [again] = verdict.add
    assert (again.name, again.action, again.target) == ("trip 1, 2", "take_photo", (5.0, 5.0, 3.0))
    assert not verdict.redo


def test_a_line_without_some_of_its_photos_has_them_taken(kit: Kit) -> None:
    """As when the app was not there while its drone flew on."""
    mission = along(kit)
    results = line(kit, mission, 1.0, 1.0, 1.0)
    verdict = hooks.stitches(mission, results._replace(all=results.all[1:]))
    assert verdict.log == ("photo trip 1, 1 missing: it is taken again",)


def test_a_line_that_is_flown_twice_has_two_photos_of_a_place(kit: Kit) -> None:
    """The better one counts."""
    mission = along(kit)
    results = line(kit, mission, 1.0, 1.0, 1.0)
    twice = [one._replace(value=replace(one.value, sharpness=0.4)) for one in results.all]
    for all in ([*twice, *results.all], [*results.all, *twice]):
        assert hooks.stitches(mission, results._replace(all=all)).log == ("3 photos fit the map",)
