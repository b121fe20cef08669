"""What goes on beside a flight: actions along its way, and the pursuit of a target that moves."""

from __future__ import annotations

from collections.abc import Awaitable, Coroutine, Mapping, Sequence
from functools import partial
from math import dist
from typing import TYPE_CHECKING, Any, NamedTuple

from ..domain.errors import ActionFailed, Cancelled, FlightFailed, HookFault
from ..domain.guard import NOT_ITS_OWN
from ..domain.keeper import put
from ..domain.model import NO_RESULT, Sighting
from ..domain.text import LONGEST_REASON, bounded, duration, quoted, text_of
from ..fleet.reach import needed
from ..flow.asking import kept_by, take_over
from ..hooks.calls import call_hook, fault_of
from ..hooks.context import Context, LiveDrone
from ..hooks.plain_data import keepable, point_of
from ..time.kernel import Future, mission_key
from .changes import keep
from .declared import CompanyDeclared, along_of, read_again
from .part import Part
from .tracks import Tracks

if TYPE_CHECKING:
    from ..domain.actions import Action
    from ..domain.model import Drone, Mission, Point, Trip
    from ..flow.engine import Engine
    from ..flow.flight import Flight
    from ..flow.mission import MissionState
    from ..time.kernel import Task
    from .declared import Along, AlongAction


class FlyingDrone(LiveDrone):
    """A drone on its way, for an action along that: its sensors, and what its camera sees."""

    __slots__ = ()

    def change_to(self, drone: Drone) -> None:
        """Be another drone from now on, which has taken over."""
        self._drone = drone

    def is_of(self, drone: Drone) -> bool:
        """Return whether it is this drone's flight; another may have taken over."""
        return True

    async def sees(self) -> list[Sighting]:
        """Return what moves in the view of its camera now."""
        return [
            Sighting(track, kind, point_of(at))
            for track, kind, at in await self._asked("sees", "camera")
        ]


class CompanyOf(CompanyDeclared):
    """Makes what goes on beside the flights of an app."""

    def __call__(self, engine: Engine) -> Company:
        """Return what sees to it in a running app."""
        return Company(engine, self.own, self.actions(engine.core.app))


class Failed(NamedTuple):
    """Why something that went on beside a flight fails that."""

    reason: str
    mends: bool = True
    """Whether another flight may do better."""


class Company(Part):
    """What goes on beside the flights of one running app."""

    def __init__(
        self, engine: Engine, own: Sequence[AlongAction], actions: Mapping[str, Action]
    ) -> None:
        """`own` are the app's own among the `actions` that can be done along the way."""
        self._core = engine.core
        self._engine = engine
        self._own = {action.name: action for action in own}
        self._actions = actions
        self._core.accompany = self.accompany
        self._arrivals: dict[str, Future[None]] = {}
        """By their ids, of the flights that something goes on beside: set at the end of the last leg."""
        self.margins: dict[Flight, float] = {}
        """The flights that are to be relieved, with what more than the way home their batteries hold then."""
        self.relieving: dict[Flight, Drone] = {}
        """The drones that are about to take flights over."""
        self._live: dict[Flight, FlyingDrone] = {}
        """The drones of the actions along the ways."""

    def tell(self, message: Mapping[str, Any]) -> None:
        """Take over that a flight has arrived."""
        if "arrived" in message and message["arrived"] in self._arrivals:
            self._arrivals[message["arrived"]].set(None)

    def go_on(self) -> None:
        """Begin again what went on beside the flights that go on."""
        for state in self._engine.states.values():
            flight = state.in_flight
            if flight is not None and state.task is not None and not flight.company:
                self._begin(state, flight, None)

    def accompany(self, state: MissionState, flight: Flight) -> dict[str, Any]:
        """Begin what goes on beside a flight that is just launched, and return the order to fly."""
        track = track_of(flight.trip)
        if track is not None:
            self._aim(flight, track)
        on_record = self._core.on_record
        recorded = None if on_record is None else on_record()
        is_accompanied = self._begin(state, flight, recorded)
        return {**flight.order, "company": True} if is_accompanied else flight.order

    def _aim(self, flight: Flight, id: str) -> None:
        """Aim a trip at where its drone will meet what it follows; no report of that yet: above its target."""
        tracks: Tracks = self._core.parts[Tracks]
        track = tracks.known.get(id)
        height = self._core.airspace.cruise_height
        x, y, z = flight.trip.target
        target = (x, y, max(z, height))
        if track is not None:
            target = tracks.meeting(track, flight.flier, height)
        put(flight.trip, target=target)

    def _begin(self, state: MissionState, flight: Flight, recorded: Awaitable[None] | None) -> bool:
        """Begin what goes on beside a flight; return whether anything does.

        An action along the way begins once its launch is `recorded`; None: it is already.
        """
        trip = flight.trip
        works: dict[str, Coroutine[Any, Any, Failed | None]] = {}
        if along := along_of(trip):
            works["action along the way"] = self._along(state, flight, along, recorded)
        if track := track_of(trip):
            works[f"pursuit of {track}"] = self._pursue(state, flight)
        if not works:
            return False
        self._arrivals[flight.id] = arrival = Future[None]()
        flight.watch(arrival.set)
        for name, work in works.items():
            task = state.spawn(work, f"{state.mission.name}: {name}")
            task.over = partial(_end, state, flight)
            task.watch(lambda _: self._leave(flight))
            flight.company += (task,)
            arrival.watch(partial(_cancel, task))
        return True

    def _leave(self, flight: Flight) -> None:
        """Expect no arrival of a flight any more that nothing goes on beside."""
        if all(task.is_set for task in flight.company):
            self._arrivals.pop(flight.id, None)

    def hand_over(self, flight: Flight, before: str, drone: Drone) -> None:
        """Let what goes on beside a flight go on with another drone; `before` was the flight's id."""
        if before in self._arrivals:
            self._arrivals[flight.id] = self._arrivals.pop(before)
        if flight in self._live:
            self._live[flight].change_to(drone)

    # Along the way

    def _along(
        self,
        state: MissionState,
        flight: Flight,
        along: Along,
        recorded: Awaitable[None] | None,
    ) -> Coroutine[Any, Any, Failed | None]:
        """Return what is done along the way; a hook may have written what cannot be."""
        try:
            given = read_again(self._actions, along)
        except ValueError as error:
            return _refused(f"trip {flight.trip.name}: its along {error}")
        own = self._own.get(given["action"])
        if own is None:
            return self._repeat(state, flight, given)
        return self._call(state, flight, own, given, recorded)

    async def _call(
        self,
        state: MissionState,
        flight: Flight,
        action: AlongAction,
        given: Along,
        recorded: Awaitable[None] | None,
    ) -> Failed | None:
        """Call the hook of an action along the way; what it raises fails the trip."""
        core = self._core
        if recorded is not None:
            await recorded
        # so time passes from one launch to the next, whatever it raises
        await core.kernel.sleep(MOMENT, key=state.key)
        await self._until_it_flies(state, flight)
        drone = flight.flier
        trip = flight.trip
        parameters = given.get("parameters") or {}
        hook = action.hook
        assert hook is not None
        live = FlyingDrone(core.kernel, core.orders, drone, mission_key(state.mission.index))
        self._live[flight] = live
        new_context = core.context or Context
        context = new_context(
            core.kernel, core.results, core.log, state.mission, lambda: state.flight, live
        )
        try:
            with kept_by(state.mission).opened() as inside:
                value = await call_hook(
                    core.kernel, inside, hook, drone, trip, context, **parameters
                )
        except NOT_ITS_OWN:
            raise
        except ActionFailed as error:
            why = bounded(text_of(error) or "it does not say why", LONGEST_REASON)
            return Failed(f"{action.name} failed: {why}")
        except BaseException as error:  # noqa: BLE001 - it is of a class of a hook's own
            fault = fault_of(hook, error)
            core.log(fault.detail, state.mission.name)
            return Failed(str(fault), mends=False)
        else:
            if value is not None:
                keep(core, state.mission, trip, keepable(value), action=action.name)
            return None
        finally:
            live.release()
            del self._live[flight]
            take_over(state, hook)

    async def _until_it_flies(self, state: MissionState, flight: Flight) -> None:
        """Wait until the drone of a flight has taken off."""
        kernel = self._core.kernel
        while flight.flier.telemetry.landed:
            await kernel.sleep(MOMENT, key=state.key)

    async def _repeat(self, state: MissionState, flight: Flight, given: Along) -> Failed | None:
        """Do a built-in action again and again on the way, without a stop, by its spacing."""
        core = self._core
        trip = flight.trip
        action = given["action"]
        parameters = given.get("parameters") or {}
        seconds = given.get("seconds")
        metres = given.get("metres", 0.0)
        over = 0.0
        here = self._last_place(state.mission, trip)
        if here is None:
            await self._begun(state, flight)
        elif seconds is None:  # it has gone on while the app was not there
            over = await self._further(state, flight, here, metres)
        while True:
            here = flight.flier.location
            if trip.action == action and dist(here[:2], trip.target[:2]) < metres / 2:
                return None  # its own action is at that place
            try:
                value = await core.orders.ask(
                    "act", flight.drone, action=action, parameters=parameters
                )
            except FlightFailed:
                return None  # the end of its flight says why
            keep(core, state.mission, trip, value, action=action, parameters=parameters)
            if seconds is None:
                over = await self._further(state, flight, here, metres - over)
            else:
                await core.kernel.sleep(seconds, key=state.key)

    def _last_place(self, mission: Mission[Any], trip: Trip) -> Point | None:
        """Return where the last result of a trip was kept since its drone left for it; None: there is none."""
        if mission.last_result == NO_RESULT or trip.start_time is None:
            return None
        result = self._core.results.results[mission.last_result]
        return result.place if result.trip is trip and result.time >= trip.start_time else None

    async def _begun(self, state: MissionState, flight: Flight) -> None:
        """Wait until a drone has taken off and, if its trip has a source, is there."""
        kernel = self._core.kernel
        await self._until_it_flies(state, flight)
        source = flight.trip.source
        if source is None:
            return
        # others in its way may have it fly higher, or lower, down to the cruise height
        near = max(AT, flight.flier.category.motion.slack)  # it turns there as near as it flies
        least = min(source[2], self._core.airspace.cruise_height) - near
        while True:
            x, y, z = flight.flier.location
            left = dist((x, y), source[:2])
            if left <= near and z >= least:
                return
            await kernel.sleep(_soon(flight.flier, left), key=state.key)

    async def _further(
        self, state: MissionState, flight: Flight, here: Point, metres: float
    ) -> float:
        """Wait until a drone is so far from a place; return by how many metres it is further."""
        near = flight.flier.category.speed * MOMENT / 2
        while (left := metres - dist(here, flight.flier.location)) > near:
            await self._core.kernel.sleep(_soon(flight.flier, left), key=state.key)
        return -left if -left < metres / 2 else 0.0  # what is later is not made up for

    # A target that moves

    async def _pursue(self, state: MissionState, flight: Flight) -> Failed | None:
        """Send the drone elsewhere each time that its target will not be where it was expected."""
        core = self._core
        trip: Any = flight.trip  # of an app whose trips may follow what moves
        tracks: Tracks = core.parts[Tracks]
        began = core.kernel.now
        while True:
            track = await tracks.next(trip.track, trip.lost_after, began)
            if track is None:
                since = duration(trip.lost_after)
                return Failed(f"track {quoted(trip.track)} has had no news for {since}")
            height = core.airspace.cruise_height
            flies = flight.flier.location[2] > height - AT
            point = tracks.meeting(track, flight.flier, height, on_its_way=flies)
            if dist(point, trip.target) <= trip.reach:
                continue
            if (why := self._out_of_reach(flight.flier, point)) is not None:
                return Failed(f"track {quoted(trip.track)} {why}")
            put(trip, target=point)
            core.orders.redirect({**flight.order, "company": True})

    def _out_of_reach(self, drone: Drone, point: Point) -> str | None:
        """Return why a drone cannot fly to a point, and home from there, or None."""
        core = self._core
        category = drone.category
        if (problem := core.airspace.problem(point)) is not None:
            return f"has gone where no drone may be: {problem}"
        share = needed(category, core.airspace, drone.location, ((point, 0.0),), drone.home)
        if share + category.reserve > drone.battery_level:
            return f"has gone too far for the battery of {drone.id}"
        return None


AT = 0.2
"""Metres that are no distance on the way."""


def _soon(drone: Drone, left: float) -> float:
    """Return in how many seconds to look again, at the earliest, whether a drone is so much further."""
    return max(MOMENT, left / drone.category.speed)


MOMENT = 0.1
"""Seconds between two looks at where a drone is."""


async def _refused(why: str) -> Failed:
    return Failed(why, mends=False)


def track_of(trip: Trip) -> str | None:
    """Return the track that a trip follows."""
    track: str | None = getattr(trip, "track", None)
    return track


def _end(state: MissionState, flight: Flight, task: Task[Failed | None]) -> None:
    """Fail a flight that is under way if what went on beside it has failed."""
    if isinstance(task.error, Cancelled):
        return
    under_way = state.flight is flight and not flight.is_set and flight.called_off is None
    if isinstance(task.error, HookFault):  # what it has left behind cannot be flown
        failed: Failed | None = Failed(str(task.error), mends=False)
        if not under_way:
            state.end(str(task.error))
    else:
        failed = task.result()
    if failed is not None and under_way:
        state.break_off(flight)
        state.fail(flight, failed.reason, mends=failed.mends)


def _cancel(task: Any, _: object) -> None:
    task.cancel()
