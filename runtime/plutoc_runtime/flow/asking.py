"""Asking a hook about a mission, and recording what it has changed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import ANY_ERROR, HookFault, MissionFailed
from ..domain.fields import Entity, FieldType, wrong_field
from ..domain.guard import NOT_ITS_OWN, unless_by_a_person
from ..domain.text import said
from ..hooks.calls import (
    Hook,
    ProtectedFacts,
    call_hook,
    changed,
    fault_of,
    hook_name,
    trace_of,
)
from ..hooks.plain_data import fields_of, trip_data

if TYPE_CHECKING:
    from ..domain.model import Mission
    from .mission import Core
    from .run import Run

MOST_CALLS = 100_000
"""Calls of hooks between two launches; a mission with more is in an endless loop, whether its hooks
return at once or sleep."""


async def ask(run: Run[Any], hook: Hook, *args: object) -> object:
    """Call one of the app's hooks; its faults end the mission."""
    run.state.calls += 1
    if run.state.calls > MOST_CALLS:
        raise MissionFailed(
            f"it goes round in its graph for ever: its hooks were called {MOST_CALLS:,} times "
            f"since its last launch, and now {hook_name(hook)} again"
        )
    mission, flying = run.mission, run.state.in_flight
    name, index = mission.name, mission.index
    held = None if flying is None else ProtectedFacts(flying.trip, "name", "action")
    try:
        answer = await call_hook(run.core.kernel, hook, *args)
    except NOT_ITS_OWN:
        raise
    except ANY_ERROR as error:
        raise fault_of(hook, error) from error
    finally:
        known = mission.name is name and mission.index is index
        if not known:
            mission.name, mission.index = name, index
        fact = held and held.put_back()
    if not known:
        raise changed(hook, "mission", "name or index")
    if fact:
        raise changed(hook, "trip", fact)
    keep(run.core, hook, mission)
    return answer


def keep(core: Core, hook: Hook, mission: Mission[Any]) -> None:
    """Check what a hook may have changed of this mission, and record it if the run may be resumed."""
    if own := [field for field in core.app.fields if not isinstance(field.type, FieldType)]:
        trips = mission.trips if type(mission.trips) is list else ()
        for entity, of in ((Entity.MISSION, mission), *((Entity.TRIP, one) for one in trips)):
            if wrong := wrong_field(own, entity, of, ()):
                left = f"hook {hook_name(hook)} left a {entity.value} that cannot go on"
                raise HookFault(f"{left}: its {wrong}")
    if core.on_record is not None:
        look(hook, partial(note_change, core), mission)


def look(hook: Hook, note: Callable[[Mission[Any]], object], mission: Mission[Any]) -> None:
    """Record what a hook has changed; a change that cannot be stored is a fault of the hook."""
    try:
        note(mission)
    except ANY_ERROR as error:
        unless_by_a_person(error)
        reason = f"hook {hook_name(hook)} left its mission so that it cannot be kept: {said(error)}"
        raise HookFault(reason, trace_of(error)) from None


def note_change(core: Core, mission: Mission[Any]) -> None:
    """Make an event of a mission as it is now."""
    app = core.app
    core.trace.note(
        "mission.changed",
        mission=mission.name,
        todo=[trip_data(app, trip) for trip in mission.trips],
        done=[trip_data(app, trip) for trip in mission.completed_trips],
        fields=fields_of(app, Entity.MISSION, mission),
    )
