"""Applying the status that a modifier returns."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..domain.errors import HookFault
from ..domain.keeper import trips_of
from ..domain.status import Status, TripStatus
from ..domain.text import bounded, shown
from ..hooks.calls import hook_name
from ..hooks.context import Context

if TYPE_CHECKING:
    from .mission import MissionState
    from .run import Run


def context_of(run: Run[Any]) -> Context:
    """Return the context that a modifier gets."""
    core = run.core
    new_context = core.context or Context
    return new_context(core.kernel, core.results, core.log, run.mission, lambda: run.state.flight)


async def settle(
    run: Run[Any],
    hook: Callable[..., object],
    status: Status,
    emits: tuple[Status, ...],
    returned: object,
) -> Status:
    """Return the status with which the mission continues; an impossible one is a fault."""
    name = f"modifier {hook_name(hook)}"
    if (wrong := undeclared(hook, emits, returned)) is not None:
        raise HookFault(wrong)
    if type(returned) is not Status:
        return status
    if (why := _contradiction(run.state, returned)) is not None:
        raise HookFault(f"{name} returned {returned.value}, but {why}")
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


def _contradiction(state: MissionState, status: Status) -> str | None:
    """Return why the mission cannot have this status, or None."""
    mission = state.mission
    trips = trips_of(state.mission)
    flying = state.in_flight
    if status is Status.RUNNING:
        return None if flying else "no trip is in flight"
    if status is Status.FAILED:
        return None
    if flying is not None:
        return f"trip {flying.trip.name} is still flying"
    if status is Status.COMPLETED:
        return f"{len(trips)} trips are still to do" if trips else None
    if not trips:
        return "no trip is left to do"
    if trips[0].status is not TripStatus.WAITING:
        return f"trip {trips[0].name} has failed; trip.reset() puts it back"
    if status is Status.UNEXECUTED and mission.attempts:
        return "the mission has flown already"
    return None


def _shown(value: object) -> str:
    return value.value if type(value) is Status else bounded(shown(value), _LONGEST)


_LONGEST = 200  # characters shown of a value that is not a status
