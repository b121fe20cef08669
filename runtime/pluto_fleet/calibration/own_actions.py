"""How long the actions of an app's own took on average, beside what plans count with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import floor, log10, sqrt
from statistics import fmean, stdev
from typing import TYPE_CHECKING, Any

from ..process.untrusted import LATEST
from ..shared.domain.actions import Action, Parameter
from ..shared.domain.quantities import Type
from ..shared.domain.text import LONGEST, counted, cut_off, number, printable, quoted
from .durations import CHANCE
from .estimates import Estimate
from .found import ActionTime, Calibration

if TYPE_CHECKING:
    from .acted import Acted
    from .commands import Flights

FEW = 3
"""From how many trips on it is told what an action takes."""


def find_own_actions(what: Calibration, journals: Sequence[Flights]) -> None:
    """Find how long each took on average; note those with which plans count otherwise.

    What plans count with is what the app said by which the newest journal was begun.
    """
    plans: dict[tuple[str, str], Mapping[str, Any]] = {}
    done: dict[tuple[str, str], list[Acted]] = {}
    for journal in sorted(journals, key=lambda one: one.begun):
        plans |= {(journal.app, name): plan for name, plan in journal.takes.items()}
        for one in journal.acted:
            done.setdefault((journal.app, one.action), []).append(one)
    enough = {which: those for which, those in sorted(done.items()) if len(those) >= FEW}
    several = len({app for app, _ in enough}) > 1
    for (app, name), those in enough.items():
        plan = plans[app, name]
        off = _off(_planned(name, plan), those)
        low, high = off.interval(1 - CHANCE / len(enough))
        seconds = fmean(one.seconds for one in those)
        planned = seconds - off.value
        found = ActionTime(
            app=app,
            name=name,
            seconds=seconds,
            low=max(planned + low, 0.0),
            high=planned + high,
            count=len(those),
            planned=planned,
            parameter=plan.get("parameter"),
        )
        what.own.append(found)
        if not low <= 0.0 <= high and _in_app(found.seconds) != _in_app(planned):
            what.notes.append(_note(found, off.value, (high - low) / 2, several))


def _planned(name: str, plan: Mapping[str, Any]) -> Action:
    """Return the action, as far as it says how long it takes."""
    parameter, seconds = plan.get("parameter"), plan["seconds"]
    if parameter is None:
        return Action(name=name, takes=seconds)
    declared = Parameter(name=parameter, type=Type.TIME, default=seconds)
    return Action(name=name, takes=parameter, parameters=(declared,))


def _off(action: Action, those: Sequence[Acted]) -> Estimate:
    """Return by how many seconds more than planned it took on average."""
    off = [one.seconds - min(action.lasts(one.parameters), LATEST) for one in those]
    count = len(off)
    return Estimate(fmean(off), stdev(off) / sqrt(count), count - 1)


def _in_app(seconds: float) -> float:
    """Return a duration as one would write it into an app: in tenths of a second below ten."""
    return max(round(seconds, 0 if seconds >= 10 else 1), 0.1)


def _note(found: ActionTime, off: float, error: float, several: bool) -> str:
    name = printable(cut_off(found.name, LONGEST))
    if several:
        name = f"{name} of {printable(cut_off(found.app, LONGEST))}"
    digits = min(max(1 - floor(log10(error)), 0), 2) if error > 0 else 2
    trips = counted(found.count, "trip")
    if found.parameter is not None:
        differs = (
            f"{abs(off):.{digits}f} s ± {error:.{digits}f} s {'longer' if off > 0 else 'shorter'}"
        )
        return (
            f"{name} took {differs} than its parameter {quoted(found.parameter)} says, on average of {trips},"
            " and plans count with what that says"
        )
    return (
        f"{name} took {found.seconds:.{digits}f} s ± {error:.{digits}f} s in {trips}, and plans count with"
        f' {number(found.planned)} s: write "takes {number(_in_app(found.seconds))} s" in the app'
    )
