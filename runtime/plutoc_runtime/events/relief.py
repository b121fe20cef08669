"""A TripMonitor with relief: another drone takes over before the one that flies must go home."""

from __future__ import annotations

from functools import partial
from math import dist
from typing import TYPE_CHECKING, Any

from ..domain.errors import FlightFailed, MissionFailed
from ..domain.status import Status
from ..fleet.policies import nearest
from ..flow.own_action import way_home
from ..flow.run import watch
from ..time.kernel import EventKind, Future, mission_key
from .company import Company
from .tracks import Tracks

if TYPE_CHECKING:
    from ..domain.model import Drone, Point
    from ..flow.flight import Flight
    from ..flow.mission import MissionState
    from ..flow.run import Run

URGENT = 1 << 20
"""The priority of who is to take over: a drone that must go home does not wait."""
NEAR = 1.0
"""Metres within which one drone takes over from another."""
LOOK = 1.0
"""Seconds from one look at a battery, or at where a drone is that is to be relieved, to the next."""


async def watch_relieved(run: Run[Any], *, relief: float) -> Status:
    """Wait for the trip's end; have another drone take over when the battery gets low by this margin."""
    flight = watch(run)
    state = run.state
    work = _relieve(state, flight, relief)
    task = run.core.kernel.spawn(work, run.key, f"{run.mission.name}: relief")
    try:
        return await flight
    finally:
        task.cancel()


async def _relieve(state: MissionState, flight: Flight, margin: float) -> None:
    """Have one drone after the other take over, as long as the flight lasts."""
    core, key = state.core, mission_key(state.mission.index)
    while not flight.is_set:
        await _until_low(state, flight, margin)
        request = core.queue.enter(state.mission, nearest, URGENT)
        try:
            drone = await request
        except MissionFailed as none:
            core.log(f"trip {flight.trip.name} is relieved by no drone: {none}", state.mission.name)
            return
        finally:
            if not request.is_set:
                core.queue.leave(request)
        taken_over = False
        try:
            taken_over = await _take_over(state, flight, drone)
        except FlightFailed as error:
            core.fleet.recover(drone, str(error))
            taken_over = True
            await core.kernel.sleep(LOOK, key=key)
        finally:
            if not taken_over:  # the flight is over, or the mission
                core.fleet.dismiss(drone)


async def _until_low(state: MissionState, flight: Flight, margin: float) -> None:
    """Wait until the battery holds only so much more than the way home and its reserve take."""
    core, key = state.core, mission_key(state.mission.index)
    while True:
        drone = flight.flier
        way = way_home(core, drone)
        left = drone.battery_level - drone.category.reserve - (way or 0.0)
        if way is not None and left <= margin:
            return
        await core.kernel.sleep(LOOK, EventKind.CLOCK, key)


async def _take_over(state: MissionState, flight: Flight, drone: Drone) -> bool:
    """Fly a drone to where another is, and have it take over; return whether it has."""
    core, key = state.core, mission_key(state.mission.index)
    core.fleet.engage(drone)
    core.transitions.note("trip.relieving", state.mission, trip=flight.trip.name, drone=drone.id)
    core.transitions.set_out(drone)
    while not flight.is_set and dist(drone.location, flight.flier.location) > NEAR:
        failed = Future[object]()
        number = core.orders.give("go", drone.id, failed.set, stops=[_beside(state, flight, drone)])
        try:
            await core.kernel.within(failed, core.kernel.now + LOOK, EventKind.TIMER, key)
        finally:
            core.orders.forget(number)
        if failed.is_set and isinstance(failed.result(), FlightFailed):
            raise failed.result()  # type: ignore[misc]  # it was asked what it is
    if flight.is_set or state.flight is not flight:
        return False
    _hand_over(state, flight, drone)
    return True


def _beside(state: MissionState, flight: Flight, drone: Drone) -> Point:
    """Return where the drone that is relieved will be met."""
    core = state.core
    track_id = getattr(flight.trip, "track", None)
    if track_id is not None:
        tracks: Tracks = core.parts[Tracks]
        track = tracks.known.get(track_id)
        if track is not None:
            return tracks.meeting(track, drone, core.airspace.cruise_height)
    return flight.flier.location


def _hand_over(state: MissionState, flight: Flight, drone: Drone) -> None:
    """Let the trip go on with this drone; the one before goes home."""
    core = state.core
    first = flight.flier
    if flight.own_action is None:  # it is on its way still
        core.orders.break_off(first.id)
    flight.flier = drone
    flight.relieved += 1
    company: Company = core.parts[Company]
    company.hand_over(flight, drone)
    core.transitions.hand_over(state.mission, flight.trip, drone)
    if flight.own_action is None:
        answer = partial(state.reported, flight)
        core.orders.fly(drone.id, answer, {**flight.order, "company": True})
    core.fleet.send_home(first)
