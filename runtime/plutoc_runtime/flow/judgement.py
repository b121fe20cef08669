"""Applying an evaluator's verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from operator import is_
from typing import TYPE_CHECKING, Any, cast

from ..domain.actions import PICK, RELEASE
from ..domain.errors import HookFault
from ..domain.guard import unless_by_a_person
from ..domain.plain import as_a
from ..domain.status import COMPLETED, FAILED, STANDBY, Status
from ..domain.text import class_of, shown, text_of
from ..fleet.reach import miss_of
from ..hooks.calls import hook_name
from ..hooks.context import Verdict
from ..hooks.soundness import taken_in, unsound
from .asking import kept_by

if TYPE_CHECKING:
    from ..domain.model import Mission, Trip
    from .mission import Core
    from .run import Run

_CONTENT = Verdict()  # the verdict of an evaluator that asks for nothing


def apply(run: Run[Any], hook: Callable[..., object], verdict: object) -> Status:
    """Apply a verdict; an invalid one is a fault of the evaluator."""
    mission = run.mission
    core = run.core
    name = hook_name(hook)
    who = f"evaluator {name}"
    if not issubclass(type(verdict), Verdict):
        raise HookFault(f"{who} must return a Verdict, not {class_of(verdict)}")
    verdict = Verdict._make(tuple.__iter__(cast("Verdict", verdict)))  # a subclass may lie
    if all(map(is_, verdict, _CONTENT)):  # as by far the most verdicts
        return COMPLETED
    redo = _listed(who, "redo", verdict.redo)
    add = _listed(who, "add", verdict.add)
    for line in _listed(who, "log", verdict.log):
        core.log(text_of(line, f"<{class_of(line)}>"), mission.name)
    if verdict.fail is not None or not (_is_ok(who, verdict.ok) or redo or add):
        reason = "" if verdict.fail is None else text_of(verdict.fail, shown(verdict.fail)).strip()
        core.transitions.judge_failed(mission, reason or f"{name} did not accept it")
        return FAILED
    for trip in redo:
        if not any(trip is done for done in mission.completed_trips):
            called = trip.name if type(trip) is core.app.trip else shown(trip)
            not_done = f"a trip that mission {mission.name} has not completed: {called!r}"
            raise HookFault(f"{who} asks to redo {not_done}")
    added = tuple(_once_each(add))
    for trip in added:
        if (problem := _problem(core, mission, trip)) is not None:
            raise HookFault(f"{who} adds a trip that cannot be flown: {problem}")
    if added:
        kept_by(mission).changed = True
    if not (redo or added):
        return COMPLETED
    core.transitions.redo(mission, tuple(_once_each(redo)), added)
    return STANDBY


def _is_ok(who: str, value: object) -> bool:
    truth = as_a(bool, value)
    if truth is None:
        raise HookFault(f"{who} must give `ok` as True or False, not {shown(value)}")
    return truth


def _listed(who: str, field: str, value: object) -> Sequence[Any]:
    for kind in (tuple, list):
        if issubclass(type(value), kind):
            return tuple(kind.__iter__(cast("Any", value)))
    try:
        if issubclass(type(value), Sequence) and not issubclass(type(value), (str, bytes)):
            return tuple(cast("Sequence[Any]", value))
    except BaseException as error:  # noqa: BLE001 - it is of a class of a hook's own
        unless_by_a_person(error)
    raise HookFault(f"{who} must give `{field}` as a list or a tuple, not as {class_of(value)}")


def _once_each(trips: Sequence[Any]) -> list[Any]:
    """Remove duplicates by identity: what is not a trip need not be hashable."""
    return list({id(trip): trip for trip in trips}.values())


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
