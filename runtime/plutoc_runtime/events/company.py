"""What goes on beside a flight: actions along its way, and the pursuit of a target that moves."""

from __future__ import annotations

from collections.abc import Callable, Container, Coroutine, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from math import dist
from typing import TYPE_CHECKING, Any, NamedTuple, Required, TypedDict, cast

from ..domain.actions import Action, Plain
from ..domain.app import parameters_data
from ..domain.errors import ActionFailed, Cancelled, FlightFailed
from ..domain.fields import Field, FieldType
from ..domain.guard import NOT_ITS_OWN
from ..domain.keeper import put
from ..domain.model import Sighting
from ..domain.quantities import Type
from ..domain.text import LONGEST_REASON, bounded, duration, quoted, text_of
from ..domain.values import Quantity, Table, one_of, read_parameters
from ..fleet.reach import needed
from ..flow.asking import kept_by, take_over
from ..hooks.calls import call_hook, fault_of
from ..hooks.context import Context, LiveDrone
from ..hooks.plain_data import keepable, point_of
from ..time.kernel import Future, mission_key
from .changes import keep
from .part import Part, PartOf
from .tracks import Tracks

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Drone, Point, Trip
    from ..flow.engine import Engine
    from ..flow.flight import Flight
    from ..flow.mission import MissionState
    from ..time.kernel import Task


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


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongAction(Action):
    """An action of the app's own that goes on while a drone flies, and not at the end of its way."""

    returns: type[object] | None = None
    """The type of what its hook gives; None: the app does not say."""


class Along(TypedDict, total=False):
    """What is done on the way: one of the app's own actions once, a built-in one every so often."""

    action: Required[str]
    parameters: Mapping[str, Plain]
    metres: float
    seconds: float


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongField(Field):
    """The field of a trip with the action along its way."""

    actions: tuple[str, ...] = ()
    """Those that can be."""

    def wanted(self, value: object, evaluators: Container[str]) -> str:
        """Return what a value must be that a hook has set, if it is not that."""
        if value is None or (type(value) is dict and value.get("action") in self.actions):
            return ""
        return f'an Along, such as {{"action": "{self.actions[0]}"}}'


@dataclass(frozen=True, slots=True)
class CompanyOf(PartOf):
    """Makes what goes on beside the flights of an app."""

    own: tuple[AlongAction, ...] = ()
    """The app's own actions on the way."""

    def __call__(self, engine: Engine) -> Company:
        """Return what sees to it in a running app."""
        return Company(engine, self.own)

    def about(self) -> dict[str, Any]:
        """Return the actions along the way, for the library."""
        actions = [
            {"name": one.name, "parameters": parameters_data(one.parameters)} for one in self.own
        ]
        return {"along": actions}

    def readers(self, app: App) -> Mapping[FieldType | Type, Callable[[Any], Any]]:
        """Return how the action along a trip's way is read."""
        named = [field for field in app.fields if isinstance(field, AlongField)]
        names = [name for field in named for name in field.actions]
        actions = {**app.actions, **{action.name: action for action in self.own}}
        return {FieldType.ALONG: partial(_read_along, {name: actions[name] for name in names})}

    def prepared(self, trip: Mapping[str, Any]) -> Mapping[str, Any]:
        """Take a target that moves apart: `target = { track = "t7" }`; where it is, is known later."""
        target = trip.get("target")
        if not isinstance(target, dict) or "track" not in target:
            return trip
        of_target = {name: one for name, one in target.items() if name in _OF_TARGET}
        unknown = {name: one for name, one in target.items() if name not in _OF_TARGET}
        return {**trip, **of_target, "target": unknown or [0.0, 0.0]}


_OF_TARGET = ("track", "reach", "lost_after")


def _read_along(actions: Mapping[str, Action], value: object) -> Along:
    """Read `"look"`, or `{ action = "take_photo", every = "2 m" }`; raise `ValueError`."""
    table = Table(value if isinstance(value, dict) else {"action": value})
    read = table.read({"action": partial(one_of, actions)}, {"every": _spacing, "parameters": None})
    action = actions.get(str(read.get("action")))
    if action is not None:
        read["parameters"] = read_parameters(table.table("parameters"), action.parameters)
        goes_on = isinstance(action, AlongAction)
        if goes_on and "every" in table.data:
            table.problem(f"{action.name} goes on all the way, and takes no every")
        elif not goes_on and "every" not in table.data:
            table.problem(f'{action.name} needs every, such as every = "2 m" or every = "1 s"')
    if table.problems:
        raise ValueError(f"is wrong: {table.problems[0].sentence}")
    every = read.pop("every", {})
    found: Any = {**read, **every}
    return cast("Along", found)


def _spacing(value: object) -> dict[str, float]:
    """Read how far apart, in metres or in seconds, something is done."""
    kinds = {
        "metres": Quantity(Type.LENGTH, 0.1, 1000.0),
        "seconds": Quantity(Type.TIME, 0.1, 3600.0),
    }
    for name, read in kinds.items():
        with suppress(ValueError):
            if isinstance(value, str):
                return {name: read(value)}
    raise ValueError('is no spacing: write a length or a time, such as "2 m" or "1 s"')


class Failed(NamedTuple):
    """Why something that went on beside a flight fails that."""

    reason: str
    mends: bool = True
    """Whether another flight may do better."""


class Company(Part):
    """What goes on beside the flights of one running app."""

    def __init__(self, engine: Engine, own: Sequence[AlongAction]) -> None:
        self._core = engine.core
        self._engine = engine
        self._own = {action.name: action for action in own}
        self._core.accompany = self.accompany
        self._arrivals: dict[str, Future[None]] = {}
        """By their ids, of the flights that something goes on beside: set at the end of the last leg."""
        self._accompanied: dict[Flight, None] = {}
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
            if flight is None or state.task is None or flight in self._accompanied:
                continue
            self._begin(state, flight)

    def accompany(self, state: MissionState, flight: Flight) -> dict[str, Any]:
        """Begin what goes on beside a flight that is just launched, and return the order to fly."""
        track = track_of(flight.trip)
        if track is not None:
            self._aim(flight, track)
        return {**flight.order, "company": True} if self._begin(state, flight) else flight.order

    def _aim(self, flight: Flight, id: str) -> None:
        """Aim a trip at where its drone will meet what it follows."""
        tracks: Tracks = self._core.parts[Tracks]
        track = tracks.known.get(id)
        if track is not None:
            height = self._core.airspace.cruise_height
            put(flight.trip, target=tracks.meeting(track, flight.flier, height))

    def _begin(self, state: MissionState, flight: Flight) -> bool:
        """Begin what goes on beside a flight; return whether anything does."""
        trip = flight.trip
        works: dict[str, Coroutine[Any, Any, Failed | None]] = {}
        if given := along_of(trip):
            name = given["action"]
            own = self._own.get(name)
            works[f"{name} along"] = (
                self._repeat(state, flight, given)
                if own is None
                else self._call(state, flight, own, given)
            )
        if track := track_of(trip):
            works[f"pursuit of {track}"] = self._pursue(state, flight)
        if not works:
            return False
        self._accompanied[flight] = None
        flight.watch(lambda _: self._accompanied.pop(flight, None))
        self._arrivals[flight.id] = arrival = Future[None]()
        flight.watch(arrival.set)
        arrival.watch(lambda _: self._arrivals.pop(flight.id, None))
        for name, work in works.items():
            task = state.spawn(work, f"{state.mission.name}: {name}")
            task.over = partial(_end, state, flight)
            flight.company += (task,)
            arrival.watch(partial(_cancel, task))
        return True

    def hand_over(self, flight: Flight, drone: Drone) -> None:
        """Let what goes on beside a flight go on with another drone; its id has just changed."""
        before = flight.id.rpartition("+")[0]
        before = before if flight.relieved == 1 else f"{before}+{flight.relieved - 1}"
        if before in self._arrivals:
            self._arrivals[flight.id] = self._arrivals.pop(before)
        if flight in self._live:
            self._live[flight].change_to(drone)

    # Along the way

    async def _call(
        self, state: MissionState, flight: Flight, action: AlongAction, given: Along
    ) -> Failed | None:
        """Call the hook of an action along the way; what it raises fails the trip."""
        core, drone, trip = self._core, flight.flier, flight.trip
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
                keep(core, state.mission, trip, keepable(value))
            return None
        finally:
            live.release()
            del self._live[flight]
            take_over(state, hook)

    async def _repeat(self, state: MissionState, flight: Flight, given: Along) -> Failed | None:
        """Do a built-in action again and again on the way, without a stop, by its spacing."""
        core = self._core
        kernel = core.kernel
        trip = flight.trip
        while flight.flier.telemetry.landed:
            await kernel.sleep(MOMENT, key=state.key)
        if trip.source is not None:
            while dist(flight.flier.location, trip.source) > AT:
                await kernel.sleep(
                    _soon(flight.flier, dist(flight.flier.location, trip.source)), key=state.key
                )
        while True:
            try:
                value = await core.orders.ask(
                    "act",
                    flight.drone,
                    action=given["action"],
                    parameters=given.get("parameters") or {},
                )
            except FlightFailed:
                return None  # the end of its flight says why
            keep(core, state.mission, trip, value)
            if "seconds" in given:
                await kernel.sleep(given["seconds"], key=state.key)
                continue
            here = flight.flier.location
            while (left := given["metres"] - dist(here, flight.flier.location)) > AT:
                await kernel.sleep(_soon(flight.flier, left), key=state.key)

    # A target that moves

    async def _pursue(self, state: MissionState, flight: Flight) -> Failed | None:
        """Send the drone elsewhere each time that its target will not be where it was expected."""
        core = self._core
        trip: Any = flight.trip  # of an app whose trips may follow what moves
        tracks: Tracks = core.parts[Tracks]
        while True:
            track = await tracks.next(trip.track, trip.lost_after)
            if track is None:
                since = duration(trip.lost_after)
                return Failed(f"track {quoted(trip.track)} has had no news for {since}")
            point = tracks.meeting(track, flight.flier, core.airspace.cruise_height)
            if dist(point, trip.target) <= trip.reach:
                continue
            if (why := self._out_of_reach(flight.flier, point)) is not None:
                return Failed(f"track {quoted(trip.track)} {why}")
            put(trip, target=point)
            core.orders.redirect({**flight.order, "company": True})

    def _out_of_reach(self, drone: Drone, point: Point) -> str | None:
        """Return why a drone cannot fly to a point, and home from there, or None."""
        core, category = self._core, drone.category
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


def along_of(trip: Trip) -> Along | None:
    """Return what is done along a trip's way."""
    along: Along | None = getattr(trip, "along", None)  # not every app has this field
    return along


def track_of(trip: Trip) -> str | None:
    """Return the track that a trip follows."""
    track: str | None = getattr(trip, "track", None)
    return track


def _end(state: MissionState, flight: Flight, task: Task[Failed | None]) -> None:
    """Fail a flight that is under way if what went on beside it has failed."""
    if isinstance(task.error, Cancelled):
        return
    failed = task.result()
    under_way = state.flight is flight and not flight.is_set and flight.called_off is None
    if failed is not None and under_way:
        state.break_off(flight)
        state.fail(flight, failed.reason, mends=failed.mends)


def _cancel(task: Any, _: object) -> None:
    task.cancel()
