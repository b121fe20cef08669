"""Targets that move, and actions along the way, in the simulated world of a package alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import dist
from typing import Any

import pytest

from pluto_fleet.shared.alone.simulate import Outcome, simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.actions import BUILT_IN
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.fields import Entity, FieldType
from pluto_fleet.shared.domain.fleet_data import DroneData, FleetData, WorldData
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.events.company import CompanyOf
from pluto_fleet.shared.events.declared import (
    TRIP_FIELDS,
    AlongAction,
    AlongField,
    Creator,
    Event,
    EventType,
)
from pluto_fleet.shared.events.follow import FOLLOW
from pluto_fleet.shared.events.raising import EventsOf
from pluto_fleet.shared.events.tracks import TracksOf
from pluto_fleet.shared.events.world import Mover
from pluto_fleet.shared.fleet.policies import nearest
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.drone_allocator.step import allocate_drone
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.trip_launcher.step import launch_trip
from plutoc_blocks.trip_monitor.relief import relieve, watch_relieved
from plutoc_blocks.trip_monitor.step import watch_trip
from tests.brain.hand import charged, settled
from tests.kit import apps


@dataclass(slots=True, kw_only=True, eq=False)
class Trip(apps.Trip):
    """A trip that may follow what moves, with an action along its way."""

    track: str | None = None
    reach: float = 0.5
    lost_after: float = 2.0
    along: Mapping[str, Any] | None = None


ALONG = AlongField(
    name="along",
    on=Entity.TRIP,
    type=FieldType.ALONG,
    label="On the way",
    actions=("look", "take_photo"),
)


def walker(*path: tuple[float, float], speed: float = 0.3, starts: float = 0.0) -> Mover:
    """Return a person that walks."""
    return Mover(name="t1", kind="person", path=path, speed=speed, starts=starts)


async def flow(run: Run[Any]) -> Status:
    """create → allocate → launch → watch."""
    status = run.status
    if run.at in (None, "pursue"):
        status = create_mission(run, status)
    while True:
        status = await allocate_drone(run, status, block="allocate", policy=nearest)
        status = await watch_trip(run, launch_trip(run, status))
        if status is not Status.STANDBY:
            return status


async def relieved(run: Run[Any]) -> Status:
    """create → allocate → launch → watch, with relief."""
    status = create_mission(run, run.status)
    status = await allocate_drone(run, status, block="allocate", policy=nearest)
    launch_trip(run, status)
    return await watch_relieved(run, status, relief=0.15)


async def untiring(run: Run[Any]) -> Status:
    """create → allocate → launch → watch, and again after each failure."""
    status = create_mission(run, run.status)
    while True:
        status = await allocate_drone(run, status, block="allocate", policy=nearest)
        status = await watch_trip(run, launch_trip(run, status))
        if status is Status.COMPLETED:
            return status


def prepared(written: Mapping[str, Any], change: Any = lambda _: None) -> Any:
    """Return create → modifier → allocate → launch → watch; the modifier writes this of the first trip."""

    def hook(mission: apps.Mission, context: Any) -> None:
        for name, value in written.items():
            setattr(mission.trips[0], name, value)
        change(mission)

    async def whole(run: Run[Any]) -> Status:
        status = create_mission(run, run.status)
        status = await modify_mission(run, status, hook=hook)
        status = await allocate_drone(run, status, block="allocate", policy=nearest)
        return await watch_trip(run, launch_trip(run, status))

    return whole


def pursuing(
    look: Any = None, chase: Any = None, flow: Any = flow, category: Category = apps.SCOUT
) -> Any:
    """Return an app that follows what moves, and looks along the way."""
    creator = Creator(event="intruder", block="pursue", hook=chase)
    creators = () if chase is None else (creator,)
    app: Any = apps.app(flow, categories=(category,)).given
    return replace(
        app,
        trip=Trip,
        fields=(*app.fields, *TRIP_FIELDS, ALONG),
        actions={**BUILT_IN, "follow": FOLLOW},
        parts=(
            EventsOf((EventType(name="intruder"),), creators),
            TracksOf(),
            CompanyOf((AlongAction(name="look", hook=look),)),
        ),
        resumes=("allocate",),
    )


def flown(
    trips: Sequence[Trip],
    *movers: Mover,
    look: Any = None,
    drones: int = 1,
    chase: Any = None,
    flow: Any = flow,
    category: Category = apps.SCOUT,
    until: float | None = None,
) -> Outcome:
    """Fly trips, each of a mission, in a world with these movers."""
    app = pursuing(look, chase, flow, category)
    fleet = FleetData(
        airspace=Airspace(),
        drones=[
            DroneData(id=f"cf{n}", category="scout", home=(float(n), 0.5, 0.0))
            for n in range(1, drones + 1)
        ],
        world=WorldData(movers=movers),
    )
    missions: list[Any] = []
    for number, trip in enumerate(trips):
        missions.append(apps.mission(f"m{number}", trip, index=number))
    return simulate(app, missions, fleet, seed=1, faults=Faults(), until=until, on_event=None)


def photos(outcome: Outcome) -> list[Mapping[str, Any]]:
    """Return the photos that were kept."""
    results = outcome.standing["results"]
    return [one["value"]["$photo"] for one in results if "$photo" in (one["value"] or {})]


def following(**more: Any) -> Trip:
    """Return a trip that takes a picture of what moves."""
    return Trip(name="picture", action="take_photo", target=(4.0, 4.0, 1.2), track="t1", **more)


def staying(seconds: float, *, every: float) -> Trip:
    """Return a trip that follows what moves, and takes pictures of it."""
    return Trip(
        name="f",
        action="follow",
        target=(4.0, 4.0, 1.2),
        track="t1",
        parameters={"for": seconds, "every": every},
    )


def test_a_drone_meets_what_moves_and_has_it_on_its_picture() -> None:
    mover = walker((8.0, 8.0), (2.0, 2.0))
    (photo,) = photos(flown([following()], mover))
    assert [track for track, _, _ in photo["tracks"]] == ["t1"]
    assert "person" in photo["sees"]


def test_time_does_not_go_back_for_what_has_moved_while_no_drone_flew() -> None:
    async def late(run: Run[Any]) -> Status:
        await run.core.kernel.sleep(60.0)
        return await flow(run)

    outcome = flown([following()], walker((8.0, 8.0), (2.0, 2.0), speed=0.1), flow=late)
    times = [event["t"] for event in outcome.events]
    assert times == sorted(times)


def test_a_drone_flies_above_what_there_is_no_report_of_yet() -> None:
    """A camera says where it is on the ground; a real drone would not fly there."""
    trip = Trip(name="p", action="take_photo", target=(4.0, 4.0, 0.0), track="t1", lost_after=9.0)
    outcome = flown([trip], walker((8.0, 8.0), (2.0, 2.0), starts=60.0), until=1.0)
    (launched,) = outcome.standing["missions"]["m0"]["todo"]
    assert launched["target"] == [4.0, 4.0, 1.2]


def test_one_that_turns_is_pursued_again() -> None:
    mover = walker((8.0, 8.0), (6.0, 8.0), (6.0, 2.0), (19.0, 2.0), speed=0.4)
    outcome = flown([following()], mover)
    (photo,) = photos(outcome)
    assert [track for track, _, _ in photo["tracks"]] == ["t1"]


def test_a_track_without_news_fails_the_trip() -> None:
    mover = walker((9.0, 9.0), (9.5, 9.0), speed=0.5)  # it leaves after a second
    outcome = flown([following()], mover)
    mission = outcome.standing["missions"]["m0"]
    assert mission["status"] == "FAILED"
    assert mission["reason"] == 'track "t1" has had no news for 2 s'


def test_each_flight_after_a_track_without_news_takes_its_time() -> None:
    """Else one that is retried without a bound would never let time go on."""
    mover = walker((9.0, 9.0), (9.5, 9.0), speed=0.5)
    outcome = flown([following()], mover, flow=untiring, until=30.0)
    launches = [event["t"] for event in outcome.events if event["event"] == "trip.launched"]
    assert 5 < len(launches) < 16
    assert all(after - before >= 2.0 for before, after in pairwise(launches))


def test_follow_stays_within_reach_and_takes_pictures() -> None:
    trip = staying(10.0, every=2.0)
    outcome = flown([trip], walker((6.0, 8.0), (6.0, 1.0), speed=0.25))
    taken = photos(outcome)
    assert len(taken) == 6
    for photo in taken:
        ((_, _, at),) = photo["tracks"]
        assert dist(photo["position"][:2], at[:2]) < 0.6


def test_one_drone_after_the_other_follows_without_a_gap() -> None:
    trip = staying(200.0, every=1.0)
    there_and_back = walker((2.0, 6.0), (8.0, 6.0), (2.0, 6.0), (8.0, 6.0), (2.0, 6.0), speed=0.08)
    weak = Category(name="scout", flight_time=120.0, charge_time=100.0)
    outcome = flown([trip], there_and_back, drones=4, flow=relieved, category=weak)
    assert outcome.standing["missions"]["m0"]["status"] == "COMPLETED"
    assert outcome.standing["missions"]["m0"]["attempts"] == 1
    assert outcome.count("trip.handed_over") >= 3
    assert outcome.count("drone.drained") == 0
    taken = photos(outcome)
    assert len(taken) == 201
    for photo in taken:
        ((_, _, at),) = photo["tracks"]
        assert dist(photo["position"][:2], at[:2]) < 1.0


def test_a_flight_that_two_monitors_watch_is_relieved_by_one_drone_at_a_time() -> None:
    """One monitor's clone may have gone on, past a gate, to the other."""

    async def twice(run: Run[Any]) -> Status:
        status = create_mission(run, run.status)
        status = await allocate_drone(run, status, block="allocate", policy=nearest)
        launch_trip(run, status)
        relieve(run, relief=0.2)
        return await watch_relieved(run, status, relief=0.15)

    weak = Category(name="scout", flight_time=120.0, charge_time=100.0)
    trip = staying(100.0, every=1.0)
    there = walker((2.0, 6.0), (8.0, 6.0), speed=0.02)
    outcome = flown([trip], there, drones=4, flow=twice, category=weak)
    assert outcome.standing["missions"]["m0"]["status"] == "COMPLETED"
    on_their_way = 0
    for event in outcome.events:
        on_their_way += event["event"] == "trip.relieving"
        on_their_way -= event["event"] == "trip.handed_over"
        assert on_their_way <= 1
    assert outcome.count("trip.handed_over") >= 1


def test_without_relief_a_battery_ends_the_trip() -> None:
    trip = staying(200.0, every=1.0)
    weak = Category(name="scout", flight_time=120.0, charge_time=1e9)
    outcome = flown(
        [trip], walker((2.0, 6.0), (18.0, 6.0), speed=0.05), flow=relieved, category=weak
    )
    assert "only just suffices" in outcome.standing["missions"]["m0"]["reason"]
    assert outcome.count("drone.drained") == 0


def test_an_action_along_the_way_sees_what_moves_and_ends_with_the_leg() -> None:
    ended: list[float] = []

    async def look(drone: Any, trip: Any, context: Any) -> None:
        try:
            while True:
                for seen in await context.live(drone).sees():
                    context.emit("intruder", id=seen.track, at=seen.at, track=seen.track)
                await context.sleep(0.2)
        finally:
            ended.append(context.now)

    made: list[Event] = []
    chase = lambda event, context: made.append(event)
    patrol = Trip(name="p", action="take_photo", target=(9.0, 0.5, 1.2), along={"action": "look"})
    outcome = flown([patrol], walker((6.0, 0.0), (6.0, 1.0), speed=0.02), look=look, chase=chase)
    assert [event.track for event in made] == ["t1"]
    assert outcome.count("event.raised") == 1
    (done,) = (event["t"] for event in outcome.events if event["event"] == "trip.completed")
    assert ended and done - ended[0] == pytest.approx(1.0)  # the photo at the end takes a second


def test_an_action_along_the_way_begins_once_its_drone_has_taken_off() -> None:
    """Else one that fails at once, and is retried without a bound, would never let time go on."""
    begun: list[tuple[float, float]] = []

    async def look(drone: Any, trip: Any, context: Any) -> None:
        begun.append((context.now, context.live(drone).position[2]))
        raise ActionFailed("the lens is dirty")

    patrol = Trip(name="p", action="take_photo", target=(9.0, 0.5, 1.2), along={"action": "look"})
    outcome = flown([patrol], look=look, flow=untiring, until=20.0)
    assert all(height > 0.0 for _, height in begun)
    assert 5 < len(begun) == outcome.count("trip.failed") < 200


def test_an_action_along_the_way_begins_once_its_launch_is_on_record() -> None:
    """A drone that hovers flies at once; if the app is killed then, nothing was done for a flight that never was."""
    looked: list[float] = []

    async def look(drone: Any, trip: Any, context: Any) -> None:
        looked.append(context.now)

    brain = charged(app=pursuing(look), recorded=True)
    brain.go_on({}, {"cf1": {}}, 0.0)
    along = {"along": {"action": "look"}}
    way = {"action": "take_photo", "target": [9.0, 0.5, 1.2], "fields": along}
    brain.begin([{"name": "m", "trips": [way]}], 0.0)
    brain.tell({"telemetry": {"cf1": {"landed": False}}}, 0.0)
    settled(brain, 5.0)
    assert brain.mission("m")["status"] == "RUNNING" and not looked
    brain.tell({"durable": 1000}, 5.0)
    settled(brain, 6.0)
    assert looked


def test_what_an_action_along_the_way_raises_fails_the_trip() -> None:
    async def look(drone: Any, trip: Any, context: Any) -> None:
        await context.sleep(1.0)
        raise ActionFailed("the lens is dirty")

    patrol = Trip(name="p", action="take_photo", target=(9.0, 0.5, 1.2), along={"action": "look"})
    outcome = flown([patrol], look=look)
    assert outcome.standing["missions"]["m0"]["reason"] == "look failed: the lens is dirty"


def line(*, metres: float, source: Point = (2.0, 4.0, 1.2), x: float = 10.0) -> Trip:
    """Return a trip along a line, with pictures on the way."""
    return Trip(
        name="line",
        action="take_photo",
        source=source,
        target=(x, source[1], source[2]),
        along={"action": "take_photo", "metres": metres},
    )


@pytest.mark.parametrize("seconds", [0.5, 100.0])
def test_what_an_action_along_the_way_leaves_behind_that_cannot_be_flown_ends_its_mission(
    seconds: float,
) -> None:
    """When it returns, and when it is called off at the end of the leg."""

    async def look(drone: Any, trip: Any, context: Any) -> None:
        trip.along = {"action": "take_photo"}
        await context.sleep(seconds)

    trip = Trip(name="t", action="take_photo", target=(3.0, 0.5, 1.2), along={"action": "look"})
    [mission] = flown([trip], look=look).standing["missions"].values()
    assert "take_photo needs metres or seconds" in mission["reason"]


def test_pictures_are_taken_on_the_way_by_their_spacing() -> None:
    taken = photos(flown([line(metres=2.0)]))
    xs = [photo["position"][0] for photo in taken]
    assert xs == pytest.approx([2.0, 4.0, 6.0, 8.0, 10.0], abs=0.3)


def test_the_picture_at_the_end_of_a_line_is_not_taken_twice() -> None:
    for metres in (0.05, 1.0, 1.143, 1.333, 1.6):
        assert len(photos(flown([line(metres=metres)]))) == round(8.0 / metres) + 1


def test_pictures_close_to_each_other_are_taken_one_by_one() -> None:
    """Not all of them at the first place, where a drone is near enough to the next one from the beginning."""
    xs = [photo["position"][0] for photo in photos(flown([line(metres=0.15, x=4.0)]))]
    assert 10 < len(xs) < 30


def test_the_first_picture_is_not_taken_while_a_drone_rises_below_it() -> None:
    taken = photos(flown([line(metres=2.0, source=(1.0, 0.5, 1.2))]))
    assert taken[0]["position"][2] > 0.9


@pytest.mark.parametrize(
    ("written", "wrong"),
    [
        ({"along": {"action": "take_photo"}}, "take_photo needs metres or seconds"),
        ({"along": {"action": "take_photo", "seconds": 0.0}}, "seconds 0.0 is not a time"),
        ({"along": {"action": "look", "metres": 1.0}}, "look goes on all the way"),
        ({"along": {"action": "look", "parameters": {"a": 1}}}, 'unknown key "a"'),
        ({"lost_after": None}, "lost_after must be a number above 0, not None"),
        ({"reach": 0.0}, "reach must be a number above 0, not 0.0"),
    ],
)
def test_what_a_hook_has_done_on_the_way_can_be_done(written: Any, wrong: str) -> None:
    """Else no time would pass from one photo to the next, or the app would end."""
    outcome = flown([line(metres=2.0)], flow=prepared(written))
    [mission] = outcome.standing["missions"].values()
    assert mission["status"] == "FAILED" and wrong in mission["reason"], mission["reason"]


def test_a_hook_has_photos_taken_on_the_way() -> None:
    along = {"action": "take_photo", "metres": 4.0}
    assert len(photos(flown([line(metres=2.0)], flow=prepared({"along": along})))) == 3


def test_what_is_done_on_the_way_is_changed_by_no_hook_in_place() -> None:
    """It could be that of another mission."""

    def spoil(mission: apps.Mission) -> None:
        mission.trips[0].along["action"] = "dance"  # type: ignore[attr-defined]

    outcome = flown([line(metres=2.0)], flow=prepared({}, spoil))
    [mission] = outcome.standing["missions"].values()
    assert "does not support item assignment" in mission["reason"]


def test_what_is_done_on_the_way_is_read_again_at_the_launch() -> None:
    """A brain is told of trips that no file, and no hook of this app, has had."""
    trip = Trip(name="t", action="take_photo", target=(3.0, 0.5, 1.2))
    trip.along = {"action": "take_photo"}
    [mission] = flown([trip]).standing["missions"].values()
    assert "take_photo needs metres or seconds" in mission["reason"]
