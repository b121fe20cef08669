"""One running mission: its state, and the outcome of its trips."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Coroutine
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from ..domain.actions import PICK, RELEASE
from ..domain.errors import FlightFailed
from ..domain.keeper import current_of
from ..domain.status import Status, TripStatus
from ..domain.text import LONGEST_LOG, bounded
from ..time.kernel import mission_key
from .flight import Flight, Limits

if TYPE_CHECKING:
    from ..domain.airspace import Airspace
    from ..domain.app import App
    from ..domain.model import Drone, Item, Mission, ResultStore, Trip
    from ..domain.trace import Trace
    from ..fleet.fleet import Fleet
    from ..fleet.orders import Orders
    from ..fleet.queue import Queue
    from ..hooks.plain_data import Data
    from ..time.kernel import Key, Task
    from ..time.told import ToldTime
    from .transitions import Changes, Transitions


@dataclass(slots=True, kw_only=True, eq=False)
class Core:
    """The parts of a running app that all its missions share."""

    app: App
    kernel: ToldTime
    airspace: Airspace
    orders: Orders
    trace: Trace
    results: ResultStore
    transitions: Transitions
    queue: Queue
    fleet: Fleet
    limits: Limits
    changes: Changes
    on_record: Callable[[], Awaitable[None]] | None = None
    """Waits until everything up to now is durable; None: this run is never resumed."""
    context: Callable[..., Any] | None = None
    """Makes what hooks are given; None: a `Context`."""
    accompany: Callable[[MissionState, Flight], dict[str, Any]] | None = None
    """Begins what goes on beside a flight, and returns the order to fly; None: nothing does."""
    parts: dict[type, Any] = field(default_factory=dict)
    """What this app has beside missions and drones, such as events, by class."""

    def log(self, text: str, mission: str | None = None) -> None:
        """Write a line on the console."""
        self.trace.note("log", mission=mission, text=bounded(text, LONGEST_LOG))


T = TypeVar("T")

Delay = tuple[str, str, int, int]  # a delay: block, trip, round, attempt


@dataclass(slots=True, eq=False)
class MissionState:
    """The state of a running mission, beside what hooks see of it."""

    core: Core
    mission: Mission[Any]
    call_off: Callable[[MissionState], Coroutine[Any, Any, None]]
    """Ends it, even if its graph would continue."""
    task: Task[Status] | None = None  # the coroutine that runs its flow
    at: str | None = None  # the last block reached at which it can resume after an interruption
    block: str = ""
    """At which block it waits now: `watch, timer` at the first blocks of a fork's branches."""
    goes_on: bool = False
    """It resumes behind a launch: the allocator and the launcher let it pass, up to its flight."""
    interrupted: bool = False  # a flight of it was interrupted and does not count
    allocated: Drone | None = None  # the drone that was allocated and is not launched yet
    flight: Flight | None = None  # the latest flight
    carrier: Drone | None = None
    """The drone that carries the mission's item, and stays with the mission."""
    carries: Item | None = None  # the item aboard `carrier`, from `pick_item` to `release_item`
    last_action_end: float | None = None  # when its previous action in this round was done
    calls: int = 0  # how often its hooks were called since its last launch, or at that instant
    launched_at: float = -1.0  # when it was launched last
    delay: tuple[Delay, float, float] | None = None
    """The delay that it waits for, when that is over, and when its round begins by the clock, or 0."""
    waited: set[Delay] | None = None  # every delay that is over
    first_start: float | None = None  # when its first trip passed a clock
    ended: bool = False
    doom: str | None = None  # why it must end at once: a failure that no retry can repair
    gone: dict[Trip, int] = field(default_factory=dict)
    """The trips that it has no more, and the round in which each left."""
    numbered: int = 0  # how many rows of trips it has
    evaluated: int = 0  # the first result that its evaluator had not seen when it was asked last
    judged: int = 0
    """The first result that its evaluator has not seen, as far as its graph has gone on since."""
    paused: float | None = None  # since when a person has it wait
    question: str | None = None  # whether an action was done: what a person is asked
    held: str | None = None
    """Why it does not fit the app as it is now: a person is asked whether it goes on."""
    answer: str | None = None  # what a person has answered
    accepted: str | None = None
    """A block that the app has no more, from which a person lets it go on."""
    replanned: bool = False  # whether a person has changed its trips
    unfit: Data | None = None
    """Its record, if the app as it is now cannot take it: it is kept as it is."""
    holds: Drone | None = None
    """The drone of a flight that was broken off, which may have the item aboard."""

    @property
    def suspended(self) -> bool:
        """Whether it was taken out of its graph."""
        return self.task is None and not self.ended

    @property
    def unsettled(self) -> Flight | None:
        """The flight that was broken off when it was taken out of its graph, and may have done its action."""
        flight = self.flight
        return flight if flight is not None and self.suspended and not flight.is_set else None

    @property
    def held_until(self) -> float | None:
        """Until when it is delayed, in the app's own time."""
        if self.delay is None:
            return None
        _, over, begins = self.delay
        return max(over, begins - self.core.kernel.drift) if begins else over

    def postpone(self, seconds: float) -> None:
        """Have its delay last longer, if it has one."""
        if self.delay is not None:
            place, over, begins = self.delay
            self.delay = (place, over + seconds, begins)

    def end(self, reason: str) -> None:
        """End it as FAILED, wherever it is in its graph; only the first reason counts."""
        if self.doom is None:
            self.doom = reason
            self.spawn(self.call_off(self), f"{self.mission.name} is doomed")

    @property
    def key(self) -> Key:
        """Its place among events at one instant."""
        return mission_key(self.mission.index)

    def spawn(self, coroutine: Coroutine[Any, Any, T], name: str) -> Task[T]:
        """Start a coroutine in its name."""
        return self.core.kernel.spawn(coroutine, self.key, name)

    @property
    def in_flight(self) -> Flight | None:
        """The flight that is not over yet."""
        flight = self.flight
        return flight if flight and flight.trip.status is _EXECUTING else None

    # Its trips

    def launch(self, drone: Drone) -> None:
        """Send a drone on the next trip."""
        core = self.core
        mission = self.mission
        last = self.flight
        trip = current_of(mission)
        if core.fleet.errands:
            core.fleet.engage(drone)
        retry = last is not None and last.trip is trip and last.failed
        action = core.app.actions[trip.action]
        self.flight = flight = Flight(mission, trip, drone, action, core.kernel.now, retry)
        self.allocated = None
        if flight.launched_at > self.launched_at:  # else they go round without any time
            self.calls = 0
        self.launched_at = flight.launched_at
        core.transitions.launch(mission, trip, drone)
        order = flight.order if core.accompany is None else core.accompany(self, flight)
        core.orders.fly(drone.id, partial(self.reported, flight), order)

    def reported(self, flight: Flight, result: object) -> None:
        """Called when a flight has arrived, is done, or has failed."""
        if self.flight is not flight or flight.trip.status is not _EXECUTING:
            return  # it was aborted meanwhile
        if isinstance(result, FlightFailed):
            self.fail(flight, flight.called_off or str(result))
        elif flight.action.hook is None:
            self.complete(flight, result)
        elif flight.called_off is None and flight.own_action is None:
            name = f"{self.mission.name}: {flight.trip.action}"
            flight.own_action = self.spawn(flight.action.act(self, flight), name)

    def break_off(self, flight: Flight) -> None:
        """Stop a flight where it is: no answer to it counts any more, and nothing more begins."""
        flight.called_off = ""
        if flight.own_action is not None:
            flight.own_action.cancel()
        flight.end_company()
        self.core.orders.break_off(flight.flier.id)

    def complete(self, flight: Flight, value: object) -> None:
        """Complete a flight's trip; its drone is free, unless it carries an item."""
        self._take_done(flight, value, found_out=False)
        if self.carrier is None:
            self.core.fleet.dismiss(flight.flier)
        else:
            self.keep_carrier(flight.flier)
        flight.set(self.mission.status)

    def _take_done(self, flight: Flight, value: object, *, found_out: bool) -> None:
        trip = flight.trip
        if trip.item is not None:
            if trip.action == PICK:
                self.carries = trip.item
                self.carrier = flight.flier
            elif trip.action == RELEASE:
                self.carries = self.carrier = None
        self.question = self.answer = None
        self.last_action_end = self.core.kernel.now
        self.core.transitions.complete(self.mission, trip, value, found_out=found_out)

    def settle(self, flight: Flight, result: object) -> None:
        """Take over what came of a flight that was broken off: its value, or a `FlightFailed`."""
        if not isinstance(result, FlightFailed):
            self._take_done(flight, result, found_out=True)
            flight.set(self.mission.status)
            return
        lost = self.carries is not None
        reason = self._take_failed(flight, str(result))
        flight.set(self.mission.status)
        if lost:
            self.end(reason)

    def _take_failed(self, flight: Flight, reason: str) -> str:
        """Fail a flight's trip; return the reason, with the item that is lost."""
        reason = self._and_its_item(reason)
        self.carries = self.carrier = self.question = self.answer = None
        self.core.transitions.fail(self.mission, flight.trip, reason)
        return reason

    def _and_its_item(self, reason: str) -> str:
        return reason if self.carries is None else f"{reason}, with {self.carries.name} aboard"

    def interrupt(self, flight: Flight, **why: str) -> None:
        """Take back a flight that was broken off before its action was done."""
        self.interrupted = True
        self.flight = self.question = self.answer = None
        self.core.transitions.interrupt(self.mission, flight.trip, **why)

    def keep_item(self, flight: Flight | None) -> Drone | None:
        """Reserve the drone that has its item aboard, or may after a flight that was broken off; return it."""
        if flight is not None and flight.trip.item is not None:
            self.holds = flight.flier
        drone = self.carrier or self.holds
        if drone is not None:
            self.keep_carrier(drone)
        return drone

    def keep_carrier(self, drone: Drone) -> None:
        """Reserve the drone that has the item aboard; if it is lost, so is the item."""
        self.core.fleet.keep(drone, self._lose)

    def _lose(self, reason: str) -> None:
        """End the mission: the drone that carries its item cannot fly on."""
        reason = self._and_its_item(reason)
        self.carries = self.carrier = self.allocated = None
        self.end(reason)

    def fail(self, flight: Flight, reason: str, *, mends: bool = True) -> None:
        """Fail a flight's trip; with an item aboard, or unless it `mends`, the mission ends as well."""
        mends = mends and self.carries is None
        why = self._take_failed(flight, reason)
        self.core.fleet.recover(flight.flier, reason)  # its own trouble, even with an item aboard
        if mends:
            flight.set(self.mission.status)
        else:
            flight.end_company()
            self.end(why)

    def abort(self, reason: str) -> None:
        """Fail the trip in flight: it has timed out, or a hook asks for it.

        A drone in another process may have done the action by the time that it is told: what came of
        an action that is not safe to repeat is reported first.
        """
        core = self.core
        flight = self.in_flight
        if flight is None or flight.called_off is not None:
            return
        repeatable = flight.action.hook is not None or flight.action.repeat == "safe"
        if core.on_record is None or repeatable:
            self.break_off(flight)
            self.fail(flight, reason)
        else:
            flight.called_off = reason
            core.orders.settle(flight.drone, flight.id)


_EXECUTING = TripStatus.EXECUTING
