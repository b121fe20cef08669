"""The built-in action `follow`: a drone stays within reach of what moves, and takes pictures of it."""

from __future__ import annotations

from collections.abc import Callable
from math import dist, inf
from typing import TYPE_CHECKING, Any

from ..domain.actions import PHOTO, Parameter
from ..domain.errors import Failure, FlightFailed
from ..domain.keeper import put
from ..domain.quantities import Type
from ..domain.text import duration, quoted
from ..flow.own_action import NO_MORE, way_home
from ..time.kernel import EventKind, Future
from .changes import keep
from .company import Company, track_of
from .declared import FOLLOWING, FollowDeclared
from .tracks import Tracks

if TYPE_CHECKING:
    from ..flow.flight import Flight
    from ..flow.mission import Core, MissionState
    from ..time.kernel import Task

ASIDE = 0.8
"""The share of the reach by which two drones keep to their sides of a target while one takes over from the other."""
ROOM = 4.0
"""How many times the reach the one that comes is away when the other makes room for it."""
STEP = 0.5
"""Seconds from one look at where it is to the next."""


class FollowAction(FollowDeclared):
    """Has the brain fly it: step by step, and picture by picture."""

    async def act(self, state: MissionState, flight: Flight) -> None:
        """Follow it, and complete or fail the flight."""
        try:
            await self._follow(state, flight)
        except FlightFailed as error:
            state.fail(flight, str(error))
        else:
            state.complete(flight, None)

    async def _follow(self, state: MissionState, flight: Flight) -> None:
        core = state.core
        trip: Any = flight.trip
        kernel = core.kernel
        told = _Told(core)
        ends = kernel.now + trip.parameters["for"]
        picture = kernel.now
        taking: Task[FlightFailed | None] | None = None
        try:
            while True:
                now = kernel.now
                if taking is not None and taking.is_set:
                    _raise(taking.result())
                    taking = None
                waits = flight.flier.telemetry.landed  # for others, until its way is free
                if now >= picture and taking is None and not waits:
                    taking = state.spawn(self._take(state, flight), f"{trip.name}: picture")
                    picture += trip.parameters["every"]
                if now >= ends:
                    if taking is not None:
                        _raise(await taking)
                    return
                way = way_home(core, flight.flier)
                left = flight.flier.battery_level - flight.flier.category.reserve
                if left <= way < inf:
                    raise FlightFailed(Failure.BATTERY, NO_MORE)
                until = min(ends, now + STEP)
                if picture > now:
                    until = min(until, picture)
                await self._stay_near(state, flight, told, until)
        finally:
            told.no_more()
            if taking is not None:
                taking.cancel()

    async def _take(self, state: MissionState, flight: Flight) -> FlightFailed | None:
        """Take a picture on the way: a camera takes its time, in which the drone flies on; return what befell it."""
        core = state.core
        try:
            photo = await core.orders.ask("act", flight.drone, action=PHOTO, parameters={})
        except FlightFailed as error:
            return error
        keep(core, state.mission, flight.trip, photo, action=PHOTO)
        return None

    async def _stay_near(
        self, state: MissionState, flight: Flight, told: _Told, until: float
    ) -> None:
        """Fly to where the target is, and on with it, until a time; raise what befalls the drone."""
        core = state.core
        trip: Any = flight.trip
        kernel = core.kernel
        id = track_of(trip)
        failed = Future[object]()
        if id is None:
            told.tell({"do": "hold", "drone": flight.drone}, failed.set)
        else:
            tracks: Tracks = core.parts[Tracks]
            track = tracks.known.get(id)
            if track is None or kernel.now - track.time > trip.lost_after:
                began = kernel.now if track is None else track.time
                track = await tracks.next(id, trip.lost_after, began)
            if track is None:
                since = duration(trip.lost_after)
                raise FlightFailed(
                    Failure.ACTION, f"track {quoted(id)} has had no news for {since}"
                )
            point, seconds = tracks.ahead(track, flight.flier, core.airspace.cruise_height)
            company: Company = core.parts[Company]
            relief = company.relieving.get(flight)
            if relief is not None and dist(relief.location, point) <= ROOM * trip.reach:
                point = tracks.aside(point, relief.location, -ASIDE * trip.reach)
                category = flight.flier.category
                metres = dist(flight.flier.location, point)
                seconds = max(seconds, category.motion.at_speed(metres, category.speed))
            put(trip, target=point)
            order = {"do": "go", "drone": flight.drone, "stops": [point], "seconds": seconds}
            told.tell(order, failed.set)
        await kernel.within(failed, until, EventKind.TIMER, state.key)
        if failed.is_set and isinstance(why := failed.result(), FlightFailed):
            raise why
        if failed.is_set:  # it has arrived
            await kernel.sleep(until - kernel.now, key=state.key)


def _raise(failed: FlightFailed | None) -> None:
    if failed is not None:
        raise failed


class _Told:
    """What the drone that follows was told last: each order comes in the place of the one before."""

    def __init__(self, core: Core) -> None:
        self._orders = core.orders
        self._drone = ""
        self._number = 0

    def tell(self, order: dict[str, Any], answer: Callable[[object], object]) -> None:
        """Tell a drone something else."""
        self._orders.forget(self._number)
        self._drone = order["drone"]
        self._number = self._orders.give(order, answer)

    def no_more(self) -> None:
        """Call off what it was told last."""
        self._orders.call_off(self._number, self._drone)


async def _nothing(*_: object) -> None:
    """Stand for the hook of an action that the brain does itself."""


FOLLOW = FollowAction(
    name=FOLLOWING,
    parameters=(
        Parameter(name="for", type=Type.TIME),
        Parameter(name="every", type=Type.TIME, default=1.0),
    ),
    repeat="safe",
    takes="for",
    hook=_nothing,
)
"""`follow(for: time, every: time)`."""
