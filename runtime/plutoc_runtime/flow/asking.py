"""Asking a hook about a mission, and taking over what it has changed: all of it, or nothing."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import takewhile
from operator import is_
from typing import TYPE_CHECKING, Any

from ..domain.errors import Cancelled, HookFault, MissionFailed
from ..domain.fields import Entity
from ..domain.guard import NOT_ITS_OWN
from ..domain.keeper import Keeper, keeper_of, put_trips, trips_of
from ..domain.status import TripStatus
from ..domain.text import class_of
from ..hooks.calls import Hook, call_hook, fault_of, hook_name
from ..hooks.plain_data import fields_of, trip_data
from ..hooks.soundness import taken_in, unsound

if TYPE_CHECKING:
    from ..domain.model import Mission, Trip
    from .mission import Core, MissionState
    from .run import Run

MOST_CALLS = 100_000
"""Calls of hooks between two launches; a mission with more is in an endless loop, whether its hooks
return at once or sleep."""


async def ask(run: Run[Any], hook: Hook, *args: object, edits: bool = False) -> object:
    """Call one of the app's hooks, which `edits` trips; its faults end the mission."""
    state = run.state
    keeper = kept_by(run.mission)
    state.calls += 1
    if state.calls > MOST_CALLS:
        raise MissionFailed(
            f"it goes round in its graph for ever: its hooks were called {MOST_CALLS:,} times "
            f"since its last launch, and now {hook_name(hook)} again"
        )
    try:
        with keeper.opened(edits=edits) as context:
            answer = await call_hook(run.core.kernel, context, hook, *args)
    except Cancelled:  # another branch was faster, and what it has changed by now counts
        try:
            take_over(state, hook)
        except HookFault as fault:
            state.end(str(fault))
        raise
    except NOT_ITS_OWN:
        raise
    except BaseException as error:
        undo(run.mission)
        raise fault_of(hook, error) from error
    take_over(state, hook)
    return answer


def kept_by(mission: Mission[Any]) -> Keeper:
    """Return the keeper of a mission that runs."""
    keeper = keeper_of(mission)
    assert keeper is not None
    return keeper


def undo(mission: Mission[Any]) -> None:
    """Put back what a hook has changed of a mission."""
    kept_by(mission).undo()
    put_trips(mission, trips_of(mission)[:])


def take_over(state: MissionState, hook: Hook) -> None:
    """Take over what a hook has changed of its mission; raise its fault if that cannot be flown."""
    core = state.core
    mission = state.mission
    keeper = kept_by(mission)
    trips = mission.trips
    before = trips_of(mission)
    if not keeper.before and len(trips) == len(before) and all(map(is_, trips, before)):
        return
    if (wrong := _wrong_trips(state, keeper)) is not None:
        undo(mission)
        raise HookFault(f"modifier {hook_name(hook)} {wrong}")
    changed = {of for (of, name), was in keeper.before.items() if getattr(of, name) != was}
    keeper.before.clear()
    keeper.changed = True
    core.changes.leave(mission, [trip for trip in before if trip not in trips])
    for trip in trips:
        if trip in changed or trip not in before:
            core.changes.trip(mission, trip)
    for trip in mission.completed_trips:
        if trip in changed:
            core.changes.trip(mission, trip)
    core.changes.mission(mission.name)
    if changed or trips != before:
        _note_change(core, mission, changed)
    before[:] = trips


def _wrong_trips(state: MissionState, keeper: Keeper) -> str | None:
    """Return what a hook did to the trips so that they cannot be flown, or None."""
    mission = state.mission
    flying = state.in_flight
    app = state.core.app
    trips: list[Trip] = [*mission.trips]
    if flying is not None and (not trips or trips[0] is not flying.trip):
        return f"took trip {flying.trip.name}, which is flying, from its place"
    written = {of for of, _ in keeper.before}
    seen = set[int]()
    for trip in trips:
        problem = None
        if type(trip) is not app.trip:
            problem = f"it must be a Trip of this app, not {class_of(trip)}"
        elif id(trip) in seen:
            problem = f"trip {trip.name}: it is in the list twice"
        elif keeper_of(trip) is not keeper:
            problem = unsound(app, state.core.airspace, trip)
            problem = problem or taken_in(mission, trip, added=False)
        elif trip.status not in _TO_DO and (flying is None or trip is not flying.trip):
            problem = f"trip {trip.name} is {trip.status.value}"
        elif trip in written:
            problem = unsound(app, state.core.airspace, trip)
        if problem is not None:
            return f"left a trip that cannot be flown: {problem}"
        seen.add(id(trip))
    return None


_TO_DO = (TripStatus.WAITING, TripStatus.FAILED)


def _note_change(core: Core, mission: Mission[Any], changed: set[Any]) -> None:
    """Make an event of what has changed: of the trips to do the part from the first to the last that has."""
    app = core.app
    old = trips_of(mission)
    new = mission.trips
    first = _alike(old, new, changed)
    last = _alike(old[first:][::-1], new[first:][::-1], changed)
    core.trace.note(
        "mission.changed",
        mission=mission.name,
        at=first,
        gone=[trip.name for trip in old[first : len(old) - last]],
        put=[trip_data(app, trip) for trip in new[first : len(new) - last]],
        done=[trip_data(app, trip) for trip in mission.completed_trips if trip in changed],
        fields=fields_of(app, Entity.MISSION, mission),
    )


def _alike(old: Sequence[Trip], new: Sequence[Trip], changed: set[Any]) -> int:
    """Return with how many trips that have not changed both lists begin."""
    both = zip(old, new, strict=False)
    alike = takewhile(lambda pair: pair[0] is pair[1] and pair[0] not in changed, both)
    return sum(1 for _ in alike)
