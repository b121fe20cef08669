"""One flight: how it begins, what navigation reports of it, and how it ends."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

from ..domain.actions import PICK, RELEASE
from ..domain.errors import ActionFailed, Failure, FlightFailed, HookFault
from ..domain.status import FAILED, Status, TripStatus
from ..domain.text import bounded, text_of
from ..hooks.calls import LONGEST_REASON, Held, Hook, call_action, changed, look
from ..hooks.context import Context
from ..hooks.keepable import keepable
from ..hooks.live_drone import LiveDrone, can_wait
from ..time.future import Future
from ..time.kernel import Task, mission_key

if TYPE_CHECKING:
    from ..domain.actions import Plain
    from ..domain.model import Drone, Item, Point, Trip
    from ..flow.mission import State


class Flight(Future[Status]):
    """One trip's flight by one drone, and the job that its navigation gets.

    It is set when the trip is over, to how the mission stands then.
    """

    __slots__ = ("_own", "called_off", "flier", "launched_at", "retry", "state", "trip")

    def __init__(self, state: State, trip: Trip, flier: Drone, retry: bool) -> None:
        super().__init__()
        self.state, self.trip, self.flier = state, trip, flier
        self.launched_at = state.core.kernel.now
        self.retry = retry
        """The mission's flight before this one was of the same trip, and failed."""
        self._own: Hook | Task[None] | None = state.core.app.actions[trip.action].hook
        """The app's own action, if it is one; once it has begun, what does it."""
        self.called_off = False
        """It was broken off, and its drone is asked what it has done."""

    # What navigation may ask

    @property
    def id(self) -> str:
        """`mission/trip/round/attempt`: the same flight has the same id in every run."""
        mission, trip = self.state.mission, self.trip
        return f"{mission.name}/{trip.name}/{mission.round}/{trip.attempt}"

    @property
    def drone(self) -> str:
        """Who flies."""
        return self.flier.id

    @property
    def stops(self) -> tuple[Point, ...]:
        """Where to fly, in order."""
        source, target = self.trip.source, self.trip.target
        return (target,) if source is None else (source, target)

    @property
    def action(self) -> str | None:
        """What to do at the last stop; None: hover, for an action of the app's own."""
        return self.trip.action if self._own is None else None

    @property
    def seconds(self) -> float:
        """How long the action is expected to take."""
        return self.state.core.app.actions[self.trip.action].seconds

    @property
    def parameters(self) -> Mapping[str, Plain]:
        """How to do it."""
        return self.trip.parameters

    @property
    def item(self) -> Item | None:
        """What to pick or to release."""
        return self.trip.item

    @property
    def failed(self) -> bool:
        """Whether it is over and went wrong."""
        return self._value is FAILED

    # What navigation tells

    def begins(self) -> None:
        """Hear that the action is about to be done."""

    def report(self, result: object) -> None:
        """Hear that the job is done and what it gave, or the `FlightFailed` that ended it."""
        state = self.state
        if state.flight is not self or self.trip.status is not _EXECUTING:
            return  # it was called off meanwhile
        if isinstance(result, FlightFailed):
            fail(state, self, str(result))
        elif self._own is None:
            complete(state, self, result)
        elif not (self.called_off or isinstance(self._own, Task)):
            self._own = state.core.kernel.spawn(
                self._act(self._own),
                mission_key(state.mission.index),
                f"{state.mission.name}: {self.trip.action}",
            )

    async def _act(self, hook: Hook) -> None:
        """Let the drone do an action of the app's own while it hovers."""
        state = self.state
        try:
            value = await self._done_while_hovering(hook)
        except FlightFailed as error:
            fail(state, self, str(error))
        except HookFault as fault:
            state.core.log(fault.detail, state.mission.name)
            fail(state, self, str(fault), mends=False)
        else:
            complete(state, self, keepable(value))

    async def _done_while_hovering(self, hook: Hook) -> object:
        state, trip, drone = self.state, self.trip, self.flier
        core = state.core
        kernel, key = core.kernel, mission_key(state.mission.index)
        core.transitions.begin_action(state.mission, trip, drone)
        if core.recorder is not None:
            await core.recorder.on_record()
        live = LiveDrone(kernel, core.navigation, drone, key) if can_wait(hook) else None
        context = Context(core, state, live)
        call = call_action(kernel, hook, drone, trip, context, **trip.parameters)
        work = kernel.spawn(call, key, f"{state.mission.name}: {trip.action}")
        hover = kernel.spawn(core.navigation.hold(drone.id), key, f"{drone.id} hovers")
        held = Held(trip, "name", "action", "item", "index", "attempt", "status")
        over: Future[None] = Future()
        work.watch(over.set)
        hover.watch(over.set)
        try:
            await over
            if hover.is_set:
                hover.result()  # raises what went wrong with the drone
            value = work.result()
        except ActionFailed as error:
            raise FlightFailed(Failure.ACTION, f"{trip.action} failed: {_why(error)}") from error
        finally:
            fact = held.put_back() if work.is_set else ""  # it may have been called off
            work.cancel()
            hover.cancel()
            if live is not None:
                live.lets_go()
        if fact:
            raise changed(hook, "trip", fact)
        if core.recorder is not None:
            look(hook, core.recorder.look, state.mission)
        return value

    def break_off(self) -> None:
        """Stop where it is; what it has done is still heard, and nothing more begins."""
        self.called_off = True
        if isinstance(self._own, Task):
            self._own.cancel()
        self.state.core.navigation.break_off(self.flier.id)


def _why(error: ActionFailed) -> str:
    """Return what an action says of its failure."""
    return bounded(text_of(error) or "it does not say why", LONGEST_REASON)


def launch(state: State, drone: Drone) -> None:
    """Send a drone on the mission's next trip."""
    core, mission, last = state.core, state.mission, state.flight
    trip = mission.trips[0] if mission.trips else mission.current
    if core.fleet.errands:
        core.fleet.engage(drone)
    retry = last is not None and last.trip is trip and last.failed
    state.flight = flight = Flight(state, trip, drone, retry)
    state.allocated, state.calls = None, 0
    core.transitions.launch(mission, trip, drone)
    core.navigation.fly(flight, flight.report)


def complete(state: State, flight: Flight, value: object) -> None:
    """A trip is over, and went well; its drone is free to go, unless it carries an item."""
    core = state.core
    if flight.trip not in state.mission.trips:
        fail(state, flight, "a hook took it from the mission's trips", mends=False)
        return
    record_done(state, flight, value)
    if state.carrier is None:
        core.fleet.dismiss(flight.flier)
    else:
        keep_carrier(state, flight.flier)
    flight.set(state.mission.status)


def record_done(state: State, flight: Flight, value: object) -> None:
    """A trip's action was done; what becomes of its drone is not said yet."""
    trip = flight.trip
    if trip.item is not None:
        _carry(state, flight, trip)
    state.last_action_end = state.core.kernel.now
    state.core.transitions.complete(state.mission, trip, value)


def keep_carrier(state: State, drone: Drone) -> None:
    """The mission's item is aboard a drone: it waits for the mission, which loses both together."""
    state.core.fleet.keep(drone, partial(_lose, state))


def _carry(state: State, flight: Flight, trip: Trip) -> None:
    """What was picked is aboard until it is released."""
    if trip.action == PICK:
        state.carries, state.carrier = trip.item, flight.flier
    elif trip.action == RELEASE:
        state.carries = state.carrier = None


def _lose(state: State, reason: str) -> None:
    """The drone that the mission keeps cannot fly on; neither it nor the item is the mission's."""
    if state.carries is not None:
        reason = f"{reason}, with {state.carries.name} aboard"
    state.carries = state.carrier = state.allocated = None
    state.end(reason)


def fail(state: State, flight: Flight, reason: str, *, mends: bool = True) -> None:
    """A trip is over, and went wrong. With an item aboard, no retry can mend it."""
    of_drone = reason  # why it is lost, if it is, has nothing to do with what it carries
    if state.carries is not None:
        reason = f"{reason}, with {state.carries.name} aboard"
        mends = False
    state.carries = state.carrier = None
    state.core.transitions.fail(state.mission, flight.trip, reason)
    state.core.fleet.recover(flight.flier, of_drone)
    if mends:
        flight.set(state.mission.status)
    else:
        state.end(reason)


def abort(state: State, reason: str) -> None:
    """Fail the trip that flies now: its limit is over, or a hook wants it so.

    Elsewhere an action may be done by the time that its drone hears of it: one that must not be
    repeated is looked up first.
    """
    core, flight = state.core, state.in_flight
    if flight is None or flight.called_off:
        return
    flight.break_off()
    repeatable = flight.action is None or core.app.actions[flight.action].repeat == "safe"
    if core.calls_off is None or repeatable:
        fail(state, flight, reason)
    else:
        core.calls_off(state, flight, reason)


_EXECUTING = TripStatus.EXECUTING
