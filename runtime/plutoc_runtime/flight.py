"""One flight: to the source, to the target, the action, and how it ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from .actions import PICK, RELEASE, Action
from .context import Context
from .energy import flight_seconds
from .errors import ActionFailed, Failure, FlightFailed, HookFault
from .hooks import call_hook
from .kernel import Key, Kind, Signal
from .navigation import Order

if TYPE_CHECKING:
    from .core import Core
    from .model import Drone, Trip
    from .run import Run
    from .state import Flight, State
    from .status import Status


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A time by which a trip must be over, and what to say when it is not."""

    until: float
    reason: str


def launch(core: Core, state: State, drone: Drone) -> None:
    """Send a drone on the mission's next trip."""
    core.fleet.engage(drone)
    flight = state.begin_flight(drone, core.kernel.now)
    core.transitions.launch(state.mission, flight.trip, drone)
    flight.task = core.kernel.spawn(
        _fly(core, state, flight),
        (state.mission.index,),
        f"{state.mission.name}: trip {flight.trip.name}",
    )


async def _fly(core: Core, state: State, flight: Flight) -> None:
    trip, drone = flight.trip, flight.drone
    action = core.app.actions[trip.action]
    stops = [point for point in (trip.source, trip.target) if point is not None]
    order = Order(
        id=f"{state.mission.name}/{trip.name}/{state.mission.round}/{trip.attempt}",
        seconds=flight_seconds(
            drone.category, core.airspace, drone.location, stops, action.seconds
        ),
    )
    try:
        await core.navigation.takeoff(drone.id, core.airspace.cruise_height, order)
        for stop in stops:
            await core.fleet.go_to(drone, stop)
        value = await _act(core, state, trip, drone, action)
    except FlightFailed as error:
        fail(core, state, flight, str(error))
    except HookFault as fault:
        core.log(fault.detail, state.mission.name)
        fail(core, state, flight, str(fault), mends=False)
    else:
        complete(core, state, flight, value)


async def _act(core: Core, state: State, trip: Trip, drone: Drone, action: Action) -> object:
    """Let the drone do its action; an action of the app's own runs while the drone hovers."""
    if action.hook is None:
        return await core.navigation.act(drone.id, trip.action, trip.parameters, trip.item)
    key = (state.mission.index,)
    call = call_hook(core.kernel, action.hook, drone, trip, Context(core, state), **trip.parameters)
    work = core.kernel.spawn(call, key, f"{state.mission.name}: {trip.action}")
    hover = core.kernel.spawn(core.navigation.hold(drone.id), key, f"{drone.id} hovers")
    over: Signal[None] = Signal()
    work.done.watch(lambda: over.set(None))
    hover.done.watch(lambda: over.set(None))
    try:
        await over
        if hover.done.is_set:
            hover.done.result()  # raises what went wrong with the drone
        return work.done.result()
    except ActionFailed as error:
        raise FlightFailed(Failure.ACTION, f"{trip.action} failed: {error}") from error
    finally:
        work.cancel()
        hover.cancel()


def complete(core: Core, state: State, flight: Flight, value: object) -> None:
    """A trip is over, and went well; its drone is free to go, unless it carries an item."""
    mission, trip = state.mission, flight.trip
    if trip not in mission.trips:
        fail(core, state, flight, "a hook took it from the mission's trips", mends=False)
        return
    if trip.action == PICK:
        state.carries, state.carrier = trip.item, flight.drone
    elif trip.action == RELEASE:
        state.carries = state.carrier = None
    flight.succeeded, state.last_action_end = True, core.kernel.now
    core.transitions.complete(mission, trip, value)
    if state.carrier is None:
        core.fleet.dismiss(flight.drone)
    else:
        core.fleet.keep(flight.drone, partial(_lose, state))
    flight.ended.set(mission.status)


def _lose(state: State, reason: str) -> None:
    """The drone that the mission keeps cannot fly on; neither it nor the item is the mission's."""
    if state.carries is not None:
        reason = f"{reason}, with {state.carries.name} aboard"
    state.carries = state.carrier = state.allocated = None
    state.doom.set(reason)


def fail(core: Core, state: State, flight: Flight, reason: str, *, mends: bool = True) -> None:
    """A trip is over, and went wrong. With an item aboard, no retry can mend it."""
    if state.carries is not None:
        reason = f"{reason}, with {state.carries.name} aboard"
        mends = False
    state.carries = state.carrier = None
    core.transitions.fail(state.mission, flight.trip, reason)
    core.fleet.recover(flight.drone)
    if mends:
        flight.ended.set(state.mission.status)
    else:
        state.doom.set(reason)


def abort(core: Core, state: State, reason: str) -> None:
    """Fail the trip that flies now; its drone breaks off and comes home."""
    flight = state.in_flight
    if flight is not None:
        if flight.task is not None:
            flight.task.cancel()
        fail(core, state, flight, reason)


async def outcome(core: Core, state: State, key: Key, limit: Limit | None = None) -> Status:
    """Wait for the end of the flight, and say how the mission stands then.

    A limit fails the trip; a trip that ends at that very instant has ended first.
    """
    flight = state.flight
    if flight is None:
        raise RuntimeError(f"mission {state.mission.name} has no flight to watch")
    if limit is not None and not await core.kernel.within(
        flight.ended, limit.until, Kind.TIMER, key
    ):
        abort(core, state, limit.reason)
    return await flight.ended


async def watch(run: Run[Any], *limits: Limit | None) -> Status:
    """Wait for the end of the flight under all limits; the soonest fails the trip."""
    given = [limit for limit in limits if limit is not None]
    soonest = min(given, key=lambda limit: limit.until, default=None)
    return await outcome(run.core, run.state, run.key, soonest)
