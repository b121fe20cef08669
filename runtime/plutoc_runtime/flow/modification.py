"""Applying the status that a modifier returns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import HookFault
from ..domain.status import Status, TripStatus
from ..domain.text import bounded, class_of, shown
from ..hooks.calls import hook_name
from ..hooks.context import Context
from ..hooks.soundness import unsound, unsound_mission
from .asking import look, note_change

if TYPE_CHECKING:
    from ..domain.model import Mission, Trip
    from .mission import Core, MissionState
    from .run import Run


def context_of(run: Run[Any]) -> Context:
    """Return the context that a modifier gets."""
    core, state = run.core, run.state
    return Context(core.kernel, core.results, core.log, run.mission, lambda: state.flight)


OpenTrips = tuple[Sequence[tuple["Trip", str, int]], int]


def open_trips(mission: Mission[Any]) -> OpenTrips:
    """Return the open trips, with their names and attempts, and how many trips there are in all."""
    to_do = [(trip, trip.name, trip.attempt) for trip in mission.trips]
    return to_do, len(to_do) + len(mission.completed_trips)


async def settle(
    run: Run[Any],
    hook: Callable[..., object],
    status: Status,
    emits: tuple[Status, ...],
    returned: object,
    before: OpenTrips,
) -> Status:
    """Return the status with which the mission continues; an impossible one is a fault."""
    name = f"modifier {hook_name(hook)}"
    if (wrong := unsound_mission(run.core.app, run.mission)) is not None:
        raise HookFault(f"{name} left a mission that cannot go on: {wrong}")
    if (wrong := _wrong_trips(run)) is not None:
        raise HookFault(f"{name} {wrong}")
    if run.core.on_record is None:  # else it has looked already
        look(hook, partial(_note_change, run.core, before), run.mission)
    if (wrong := undeclared(hook, emits, returned)) is not None:
        raise HookFault(wrong)
    if type(returned) is not Status:
        return status
    lie = _contradiction(run.state, returned)
    if lie is not None:
        raise HookFault(f"{name} returned {returned.value}, but {lie}")
    flight = run.state.in_flight
    if returned is Status.FAILED and flight is not None:
        run.state.abort(f"{name} failed the trip")
        ended = await flight  # which may have been done just before
        if ended in emits:
            return ended
    if returned is not run.mission.status:
        reason = f"{name} failed the mission" if returned is Status.FAILED else ""
        run.core.transitions.modify(run.mission, returned, reason)
    return returned


def undeclared(
    hook: Callable[..., object], emits: tuple[Status, ...], returned: object
) -> str | None:
    """Return what is wrong with what a modifier returned, or None."""
    name = f"modifier {hook_name(hook)}"
    if not emits and returned is not None:
        return f"{name} declares no `emits` and so must return nothing, not {_shown(returned)}"
    if emits and (type(returned) is not Status or returned not in emits):
        declared = ", ".join(status.value for status in emits)
        return f"{name} must return one of {declared}, not {_shown(returned)}"
    return None


def _wrong_trips(run: Run[Any]) -> str | None:
    """Return what the modifier did to the trips so that they cannot be flown, or None."""
    mission, flying = run.mission, run.state.in_flight
    if type(mission.trips) is not list:
        return f"made mission.trips {class_of(mission.trips)}, not a list"
    if flying is not None and (not mission.trips or mission.trips[0] is not flying.trip):
        return f"took trip {flying.trip.name}, which is flying, from its place"
    seen: set[int] = set()
    for trip in mission.trips:
        problem = unsound(run.core.app, run.core.airspace, trip)
        if problem is None and id(trip) in seen:
            problem = f"trip {trip.name}: it is in the list twice"
        if problem is not None:
            return f"left a trip that cannot be flown: {problem}"
        seen.add(id(trip))
    return None


def _note_change(core: Core, before: OpenTrips, mission: Mission[Any]) -> None:
    """Record that the hook has changed the trips; those completed meanwhile do not count."""
    to_do, trips = before
    left = [known for known in to_do if known[0].status is not TripStatus.COMPLETED]
    if core.trace.live and open_trips(mission) != (left, trips):
        note_change(core, mission)


def _contradiction(state: MissionState, status: Status) -> str | None:
    """Return why the mission cannot have this status, or None."""
    mission = state.mission
    flying = state.in_flight
    if status is Status.RUNNING:
        return None if flying else "no trip is in flight"
    if status is Status.FAILED:
        return None
    if flying is not None:
        return f"trip {flying.trip.name} is still flying"
    if status is Status.COMPLETED:
        return f"{len(mission.trips)} trips are still to do" if mission.trips else None
    if not mission.trips:
        return "no trip is left to do"
    if mission.current.status is not TripStatus.WAITING:
        return f"trip {mission.current.name} has failed; trip.reset() puts it back"
    if status is Status.UNEXECUTED and mission.attempts:
        return "the mission has flown already"
    return None


def _shown(value: object) -> str:
    return value.value if type(value) is Status else bounded(shown(value), _LONGEST)


_LONGEST = 200  # characters shown of a value that is not a status
