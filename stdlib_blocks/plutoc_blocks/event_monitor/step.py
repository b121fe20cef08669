"""What an EventMonitor does."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import FlightFailed
from plutoc_runtime.events.raising import Events
from plutoc_runtime.flow.run import watch
from plutoc_runtime.time.kernel import EventKind

if TYPE_CHECKING:
    from plutoc_runtime.domain.status import Status
    from plutoc_runtime.events.declared import Event
    from plutoc_runtime.flow.flight import Flight
    from plutoc_runtime.flow.mission import MissionState
    from plutoc_runtime.flow.run import Run


async def wait_for_event(
    run: Run[Any], status: Status, *, event: str, of_any: bool = False
) -> Status:
    """Wait for the trip's end, and break the flight off if the event comes first."""
    flight = watch(run)
    core = run.core
    own = None if of_any else run.mission.name
    waits = core.parts[Events].wait(event, own)
    waiting = core.kernel.spawn(waits, run.key, f"{run.mission.name} waits for {event}")
    flight.watch(waiting_is_over := partial(_stop, waiting))
    try:
        await waiting.ended()
        if not flight.is_set:
            # a trip that ends at this instant has ended first
            await core.kernel.within(flight, core.kernel.now, EventKind.TIMER, run.key)
        if not flight.is_set:
            break_off(run.state, flight, waiting.result())
        return await flight
    finally:
        flight.unwatch(waiting_is_over)
        waiting.cancel()


def _stop(waiting: Any, _: object) -> None:
    waiting.cancel()


def break_off(state: MissionState, flight: Flight, event: Event) -> None:
    """Break a flight off because of an event: its trip waits again, and no attempt is charged.

    What came of an action that is not safe to repeat is found out first: a trip that was done is done.
    """
    core = state.core
    if flight.called_off is not None:
        return  # it ends already
    repeatable = flight.action.hook is not None or flight.action.repeat == "safe"
    if core.on_record is None or repeatable:
        state.break_off(flight)
        _take_back(state, flight, event)
        return
    flight.called_off = f"event {event.id} has interrupted it"
    core.orders.settle(flight.drone, flight.id, partial(_settled, state, flight, event))


def _settled(state: MissionState, flight: Flight, event: Event, result: object) -> None:
    """Take over what came of a flight that was stopped by an event."""
    if isinstance(result, FlightFailed):
        _take_back(state, flight, event)
    else:
        state.reported(flight, result)


def _take_back(state: MissionState, flight: Flight, event: Event) -> None:
    """Have the trip wait again; its drone hovers, and stays the mission's until the next allocation."""
    core = state.core
    state.interrupt(flight)
    if state.carrier is None:
        core.parts[Events].reserve(state.mission.name, flight.flier)
    else:
        state.keep_carrier(flight.flier)
    flight.set(state.mission.status)
