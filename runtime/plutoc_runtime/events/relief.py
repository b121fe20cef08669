"""A TripMonitor with relief: another drone takes over before the one that flies must go home."""

from __future__ import annotations

from functools import partial
from math import dist, inf
from typing import TYPE_CHECKING, Any

from ..domain.errors import FlightFailed, MissionFailed
from ..fleet.policies import nearest
from ..flow.own_action import way_home
from ..time.kernel import EventKind, Future
from .company import Company
from .follow import FollowAction
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
LOOK = 0.25
"""Seconds from one look at a battery, or at where a drone is that is to be relieved, to the next."""


def relieve_at(run: Run[Any], level: float) -> None:
    """Have the flight of this moment taken over once its battery holds only the way home and this."""
    state = run.state
    flight = state.flight
    if flight is not None and not flight.is_set:
        work = _relieve(state, flight, level)
        task = state.spawn(work, f"{state.mission.name}: relief")
        flight.watch(lambda _: task.cancel())


async def _relieve(state: MissionState, flight: Flight, margin: float) -> None:
    """Have one drone after the other take over, as long as the flight lasts."""
    core = state.core
    while not flight.is_set:
        await _until_low(state, flight, margin)
        if flight.own_action is not None and not isinstance(flight.action, FollowAction):
            return  # what has begun is done by the drone that began it
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
            await core.kernel.sleep(LOOK, key=state.key)
        finally:
            if not taken_over:  # the flight is over, or the mission
                core.fleet.dismiss(drone)


async def _until_low(state: MissionState, flight: Flight, margin: float) -> None:
    """Wait until the battery holds only so much more than the way home and its reserve take."""
    core = state.core
    while True:
        drone = flight.flier
        way = way_home(core, drone)
        left = drone.battery_level - drone.category.reserve - way
        if way < inf and left <= margin:
            return
        await core.kernel.sleep(LOOK, EventKind.CLOCK, state.key)


async def _take_over(state: MissionState, flight: Flight, drone: Drone) -> bool:
    """Fly a drone to where another is, and have it take over; return whether it has."""
    core = state.core
    core.fleet.engage(drone)
    core.transitions.note("trip.relieving", state.mission, trip=flight.trip.name, drone=drone.id)
    core.transitions.set_out(drone)
    going: Future[object] | None = None
    number = 0
    goal = drone.location
    try:
        while not flight.is_set and dist(drone.location, flight.flier.location) > NEAR:
            place = _beside(state, flight, drone)
            if going is None or going.is_set or dist(place, goal) > NEAR / 2:
                core.orders.forget(number)
                going = Future()
                goal = place
                order = {"do": "go", "drone": drone.id, "stops": [place]}
                number = core.orders.give(order, going.set)
            await core.kernel.within(going, core.kernel.now + LOOK, EventKind.TIMER, state.key)
            if going.is_set and isinstance(failed := going.result(), FlightFailed):
                raise failed
            if going.is_set:  # it is where the other was
                await core.kernel.sleep(LOOK, key=state.key)
    finally:
        core.orders.forget(number)
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
