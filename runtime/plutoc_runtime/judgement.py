"""What becomes of an evaluator's verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from .actions import PICK, RELEASE
from .core import Core
from .errors import HookFault
from .hooks import hook_name
from .model import Mission, Trip
from .plan_check import why_not
from .run import Run
from .status import Status
from .verdict import Verdict


def apply(run: Run[Any], hook: Callable[..., object], verdict: object) -> Status:
    """Do as the verdict says; one that cannot be followed is a fault of the evaluator."""
    mission, core, name = run.mission, run.core, hook_name(hook)
    if not isinstance(verdict, Verdict):
        raise HookFault(f"evaluator {name} must return a Verdict, not {type(verdict).__name__}")
    for line in verdict.log:
        core.log(str(line), mission.name)
    if verdict.fail is not None or not (verdict.ok or verdict.redo or verdict.add):
        core.transitions.judge_failed(mission, verdict.fail or f"{name} did not accept it")
        return Status.FAILED
    for trip in verdict.redo:
        if trip not in mission.completed_trips:
            raise HookFault(
                f"evaluator {name} asks to redo a trip that mission {mission.name} "
                f"has not completed: {getattr(trip, 'name', trip)!r}"
            )
    added = tuple(_accepted(core, mission, name, trip) for trip in dict.fromkeys(verdict.add))
    _name(mission, added)
    if not (verdict.redo or added):
        return Status.COMPLETED
    core.transitions.redo(mission, tuple(dict.fromkeys(verdict.redo)), added)
    return Status.STANDBY


def _accepted(core: Core, mission: Mission[Any], evaluator: str, trip: Trip) -> Trip:
    """Make a new trip complete, or say why it cannot be flown."""
    problem = _problem(core, mission, trip)
    if problem is not None:
        raise HookFault(f"evaluator {evaluator} adds a trip that cannot be flown: {problem}")
    parameters = core.app.actions[trip.action].parameters
    defaults = {p.name: p.default for p in parameters if p.default is not None}
    trip.parameters = {**defaults, **trip.parameters}
    return trip


def _name(mission: Mission[Any], added: Sequence[Trip]) -> None:
    """Give each new trip a name of its own: it tells its flights and results from all others."""
    taken = {known.name for known in (*mission.trips, *mission.completed_trips)}
    for trip in added:
        name, number = trip.name, 1
        while trip.name in taken:
            number += 1
            trip.name = f"{name} {number}"
        taken.add(trip.name)


def _problem(core: Core, mission: Mission[Any], trip: object) -> str | None:
    if not isinstance(trip, core.app.trip):
        return f"it must be a Trip of this app, not {type(trip).__name__}"
    if trip in mission.completed_trips or trip in mission.trips:
        return f"trip {trip.name} is the mission's already: ask to redo it"
    action = core.app.actions.get(trip.action)
    if action is None:
        return f"there is no action {trip.action!r}"
    if trip.action in (PICK, RELEASE):
        return "items are planned by the user: pick and release cannot be added"
    known = {parameter.name for parameter in action.parameters}
    needed = {parameter.name for parameter in action.parameters if parameter.default is None}
    for name in (*sorted(trip.parameters.keys() - known), *sorted(needed - trip.parameters.keys())):
        what = "has no parameter" if name not in known else "needs the parameter"
        return f"{trip.action} {what} {name!r}"
    for point in (trip.source, trip.target):
        outside = None if point is None else core.airspace.problem(point)
        if outside is not None:
            return outside
    reasons = [
        why_not(core.app, core.airspace, drone.category, drone.home, (trip,))
        for drone in core.fleet.drones
    ]
    return None if None in reasons else "; ".join(dict.fromkeys(r for r in reasons if r))
