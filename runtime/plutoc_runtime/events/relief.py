"""A TripMonitor with relief: another drone takes over before the one that flies must go home."""

from __future__ import annotations

from functools import partial
from math import dist, inf
from typing import TYPE_CHECKING, Any

from ..domain.errors import FlightFailed, MissionFailed
from ..fleet.policies import nearest
from ..flow.own_action import way_home
from ..time.kernel import EventKind, Future
from .changes import hand_over, relieve
from .company import Company, track_of
from .follow import ASIDE, FollowAction
from .tracks import Tracks

if TYPE_CHECKING:
    from ..domain.model import Drone, Point, Trip
    from ..flow.flight import Flight
    from ..flow.mission import MissionState
    from ..flow.run import Run

URGENT = 1 << 20
"""The priority of who is to take over: a drone that must go home does not wait."""
REACH = 0.5
"""Metres within which one drone takes over from another, where a trip says nothing of it."""
AT_LAST = 0.01
"""The share of a battery from which on, if there is no more to spare, a drone that is kept off takes over from where it is."""
KEPT_OFF_WITHIN = 3.0
"""How many times the reach that may be away."""
LOOK = 0.25
"""Seconds from one look at a battery, or at where a drone is that is to be relieved, to the next."""


def relieve_at(run: Run[Any], level: float) -> None:
    """Have the flight of this moment taken over once its battery holds only the way home and this."""
    state = run.state
    flight = state.flight
    if flight is None or flight.is_set:
        return
    margins = run.core.parts[Company].margins
    is_watched = flight in margins  # by another monitor of the same flight
    margins[flight] = max(level, margins.get(flight, level))
    if is_watched:
        return
    task = state.spawn(_relieve(state, flight), f"{state.mission.name}: relief")
    flight.company += (task,)
    flight.watch(lambda _: task.cancel())
    flight.watch(margins.pop)


async def _relieve(state: MissionState, flight: Flight) -> None:
    """Have one drone after the other take over, as long as the flight lasts."""
    core = state.core
    while not flight.is_set:
        await _until_low(state, flight)
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
        finally:
            if not taken_over:  # the flight is over, or the mission
                core.fleet.dismiss(drone)
        # who takes over may be low as well: time passes until it is relieved
        await core.kernel.sleep(LOOK, key=state.key)


async def _until_low(state: MissionState, flight: Flight) -> None:
    """Wait until the battery holds only so much more than the way home and its reserve take."""
    kernel = state.core.kernel
    company: Company = state.core.parts[Company]
    while _spare(state, flight) > company.margins[flight]:
        await kernel.sleep(LOOK, EventKind.CLOCK, state.key)


def _spare(state: MissionState, flight: Flight) -> float:
    """Return the share of a battery that the way home and the reserve leave; infinite: there is no way home now."""
    drone = flight.flier
    way = way_home(state.core, drone)
    return drone.battery_level - drone.category.reserve - way if way < inf else inf


async def _take_over(state: MissionState, flight: Flight, drone: Drone) -> bool:
    """Fly a drone to where another is, and have it take over; return whether it has."""
    core = state.core
    core.fleet.engage(drone)
    relieve(core, state.mission, flight.trip, drone)
    going: Future[object] | None = None
    number = 0
    goal = drone.location
    company: Company = core.parts[Company]
    company.relieving[flight] = drone
    try:
        while not flight.is_set and not _is_near_enough(state, flight, drone):
            place = _beside(state, flight, drone)
            if going is None or going.is_set or dist(place, goal) > reach_of(flight.trip) / 2:
                core.orders.forget(number)
                going = Future()
                goal = place
                order = {"do": "go", "drone": drone.id, "stops": [place], "seconds": 0.0}
                number = core.orders.give(order, going.set)
            await core.kernel.within(going, core.kernel.now + LOOK, EventKind.TIMER, state.key)
            if going.is_set and isinstance(failed := going.result(), FlightFailed):
                raise failed
            if going.is_set:  # it is where the other was
                await core.kernel.sleep(LOOK, key=state.key)
    finally:
        del company.relieving[flight]
        core.orders.call_off(number, drone.id)
    if flight.is_set or state.flight is not flight:
        return False
    _hand_over(state, flight, drone)
    return True


def _is_near_enough(state: MissionState, flight: Flight, drone: Drone) -> bool:
    """Return whether a drone is within reach; if others keep it off until there is little left, near it."""
    reach = reach_of(flight.trip)
    metres = dist(drone.location, _where(state, flight))
    is_late = _spare(state, flight) <= AT_LAST
    return metres <= (KEPT_OFF_WITHIN * reach if is_late else reach)


def reach_of(trip: Trip) -> float:
    """Return the metres within which what a trip is about is reached."""
    reach: float = getattr(trip, "reach", REACH)  # not every app has this field
    return reach


def _where(state: MissionState, flight: Flight) -> Point:
    """Return where the drone that is relieved ought to be now."""
    core = state.core
    track = core.parts[Tracks].known.get(track_of(flight.trip) or "")
    if track is None:
        return flight.flier.location
    x, y, z = track.place(core.kernel.now)
    return x, y, z + core.airspace.cruise_height


def _beside(state: MissionState, flight: Flight, drone: Drone) -> Point:
    """Return where the drone that is relieved will be met."""
    core = state.core
    tracks: Tracks = core.parts[Tracks]
    track = tracks.known.get(track_of(flight.trip) or "")
    if track is None:
        return flight.flier.location
    met = tracks.meeting(track, drone, core.airspace.cruise_height)
    return tracks.aside(met, drone.location, ASIDE * reach_of(flight.trip))


def _hand_over(state: MissionState, flight: Flight, drone: Drone) -> None:
    """Let the trip go on with this drone; the one before goes home."""
    core = state.core
    first = flight.flier
    away = dist(drone.location, _where(state, flight))
    if flight.own_action is None:  # it is on its way still
        core.orders.break_off(first.id)
    before = flight.id
    flight.flier = drone
    flight.relieved += 1
    company: Company = core.parts[Company]
    company.hand_over(flight, before, drone)
    hand_over(core, state.mission, flight.trip, drone, away, reach_of(flight.trip))
    if flight.own_action is None:
        answer = partial(state.reported, flight)
        core.orders.fly(drone.id, answer, {**flight.order, "company": True})
    core.fleet.send_home(first)
