"""What becomes of an evaluator's verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from .actions import PICK, RELEASE
from .capability import why_not
from .errors import HookFault
from .hooks import hook_name
from .soundness import unsound
from .status import COMPLETED, FAILED, STANDBY, Status, TripStatus
from .verdict import Verdict

if TYPE_CHECKING:
    from .core import Core
    from .model import Mission, Trip
    from .run import Run


def apply(run: Run[Any], hook: Callable[..., object], verdict: object) -> Status:
    """Do as the verdict says; one that cannot be followed is a fault of the evaluator."""
    mission, core = run.mission, run.core
    if not isinstance(verdict, Verdict):
        what = type(verdict).__name__
        raise HookFault(f"evaluator {hook_name(hook)} must return a Verdict, not {what}")
    if mission.trips:
        raise HookFault(
            f"evaluator {hook_name(hook)} changed the mission's trips: that is what `add` is for"
        )
    if verdict.ok and verdict.fail is None and verdict.asks_nothing:
        return COMPLETED
    name = hook_name(hook)
    redo, add = _listed(name, "redo", verdict.redo), _listed(name, "add", verdict.add)
    for line in _listed(name, "log", verdict.log):
        core.log(str(line), mission.name)
    if verdict.fail is not None or not (verdict.ok or redo or add):
        reason = "" if verdict.fail is None else str(verdict.fail).strip()
        core.transitions.judge_failed(mission, reason or f"{name} did not accept it")
        return FAILED
    for trip in redo:
        if trip not in mission.completed_trips:
            raise HookFault(
                f"evaluator {name} asks to redo a trip that mission {mission.name} "
                f"has not completed: {getattr(trip, 'name', trip)!r}"
            )
    added = tuple(_accepted(core, mission, name, trip) for trip in _once_each(add))
    _name(mission, added)
    if not (redo or added):
        return COMPLETED
    core.transitions.redo(mission, tuple(_once_each(redo)), added)
    return STANDBY


def _listed(evaluator: str, field: str, value: object) -> Sequence[Any]:
    if isinstance(value, (tuple, list)):
        return value
    raise HookFault(
        f"evaluator {evaluator} must give `{field}` as a tuple, not as {type(value).__name__}"
    )


def _once_each(trips: Sequence[Any]) -> list[Any]:
    """Leave out what is asked for twice; what is no trip at all need not be hashable."""
    return list({id(trip): trip for trip in trips}.values())


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


def _problem(core: Core, mission: Mission[Any], trip: Trip) -> str | None:
    problem = unsound(core, trip)
    if problem is not None:
        return problem
    if trip in mission.completed_trips:
        return f"trip {trip.name} is the mission's already: ask to redo it"
    if trip.now is not None or trip.status is not TripStatus.WAITING:
        return f"trip {trip.name} has been used already: make a new Trip each time"
    if trip.action in (PICK, RELEASE):
        return "items are planned by the user: pick and release cannot be added"
    reasons = [
        why_not(core.app, core.airspace, drone.category, drone.home, (trip,))
        for drone in core.fleet.drones
    ]
    return None if None in reasons else "; ".join(dict.fromkeys(r for r in reasons if r))
