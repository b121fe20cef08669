"""Applying an evaluator's verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from ..domain.actions import PICK, RELEASE
from ..domain.errors import HookFault
from ..domain.guard import unless_by_a_person
from ..domain.plain import as_a
from ..domain.status import COMPLETED, FAILED, STANDBY, Status
from ..domain.text import class_of, shown, text_of
from ..fleet.reach import miss_of
from ..hooks.calls import fault_of, hook_name
from ..hooks.context import Verdict
from ..hooks.soundness import taken_in, unsound
from .asking import kept_by

if TYPE_CHECKING:
    from ..domain.model import Mission, Trip
    from .mission import Core
    from .run import Run

_CONTENT = Verdict()  # the verdict of an evaluator that asks for nothing


def apply(run: Run[Any], hook: Callable[..., object], verdict: object) -> Status:
    """Apply a verdict; one that cannot be followed, or even read, is a fault of the evaluator."""
    try:
        return _applied(run, hook, verdict)
    except HookFault:
        raise
    except BaseException as error:
        unless_by_a_person(error)
        raise fault_of(hook, error) from error


def _applied(run: Run[Any], hook: Callable[..., object], verdict: object) -> Status:
    mission = run.mission
    core = run.core
    name = hook_name(hook)
    who = f"evaluator {name}"
    if not isinstance(verdict, Verdict):
        raise HookFault(f"{who} must return a Verdict, not {class_of(verdict)}")
    if verdict == _CONTENT:  # as by far the most verdicts
        return COMPLETED
    redo = _once_each(_listed(who, "redo", verdict.redo))
    added = _once_each(_listed(who, "add", verdict.add))
    for line in _listed(who, "log", verdict.log):
        core.log(text_of(line, f"<{class_of(line)}>"), mission.name)
    ok = as_a(bool, verdict.ok)
    reason = ""
    if verdict.fail is not None:
        reason = text_of(verdict.fail, shown(verdict.fail)).strip()
    elif ok is None:
        raise HookFault(f"{who} must give `ok` as True or False, not {shown(verdict.ok)}")
    if verdict.fail is not None or not (ok or redo or added):
        core.transitions.judge_failed(mission, reason or f"{name} did not accept it")
        return FAILED
    if not (redo or added):
        return COMPLETED
    for trip in redo:
        if not any(trip is done for done in mission.completed_trips):
            called = trip.name if type(trip) is core.app.trip else shown(trip)
            not_done = f"a trip that mission {mission.name} has not completed: {called!r}"
            raise HookFault(f"{who} asks to redo {not_done}")
    for trip in added:
        if (problem := _problem(core, mission, trip)) is not None:
            raise HookFault(f"{who} adds a trip that cannot be flown: {problem}")
    if added:
        kept_by(mission).changed = True
    core.transitions.redo(mission, redo, added)
    return STANDBY


def _listed(who: str, field: str, value: object) -> Sequence[Any]:
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
        return value
    raise HookFault(f"{who} must give `{field}` as a list or a tuple, not as {class_of(value)}")


def _once_each(trips: Sequence[Any]) -> tuple[Any, ...]:
    """Remove duplicates by identity: what is not a trip need not be hashable."""
    return tuple({id(trip): trip for trip in trips}.values())


def _problem(core: Core, mission: Mission[Any], trip: Trip) -> str | None:
    if any(trip is done for done in mission.completed_trips):
        return f"trip {trip.name} is the mission's already: ask to redo it"
    problem = unsound(core.app, core.airspace, trip)
    if problem is not None:
        return problem
    if trip.action in (PICK, RELEASE):
        return "items are planned by the user: pick and release cannot be added"
    misses = [
        miss_of(core.app, core.airspace, drone.category, drone.home, (trip,))
        for drone in core.fleet.drones
    ]
    if None not in misses:
        return "; ".join(dict.fromkeys(m.reason for m in misses if m))
    return taken_in(mission, trip, added=True)
