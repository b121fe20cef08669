"""How drones move, fitted to their commands, and what of `Motion` can be found.

A command takes F · (pace · what its way takes + its overheads), with a factor F of its own, around 1. What
flights take of a battery, and how long it takes to charge it, are fitted to the telemetry around them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import dist, floor, log10, sqrt
from statistics import fmean, stdev
from typing import Any

from ..jobs.flown import ACTION, BROKEN_OFF, DONE, LAND, LEG, TAKE_OFF
from ..process.untrusted import LATEST
from ..shared.domain.actions import BUILT_IN, Action, Parameter
from ..shared.domain.motion import Motion, charging
from ..shared.domain.quantities import Type
from ..shared.domain.text import LONGEST, counted, cut_off, number, printable, quoted
from .commands import Acted, Command, Flights
from .estimates import (
    SPARE,
    SURE,
    ActionTime,
    Calibration,
    Estimate,
    Fit,
    Found,
    Row,
    Spread,
    fitted,
    student,
    too_few,
)
from .moves import (
    NEAR,
    OVERHEAD,
    PARAMETERS,
    TICK,
    fit_of,
    leaves_pace_open,
    measured,
    with_value,
)
from .shapes import SHAPES, shaped

MOVED = 0.01
"""Metres from which on a leg counts: a drone that is there already need not fly."""
CHANCE = 0.001
"""How probable a difference may be by chance to be noted."""
_SHORT = (1, 2, 3, 4)
"""How many eighths of all legs may be the short ones."""
_FROM = {
    "pace": (LEG, "leg"),
    "settles": (LEG, "leg"),
    "take_off": (TAKE_OFF, "take-off"),
    "landing": (LAND, "landing"),
}
"""From which commands each is found, and what people call these."""


def find_durations(what: Calibration, done: Sequence[Command]) -> None:
    """Find pace, overheads and spread from all commands that move a drone."""
    moves = [one for one in done if one.what != ACTION and one.metres >= MOVED]
    known = _known(what, moves)
    moves = [one for one in moves if OVERHEAD.get(one.what) not in known]
    fit = fit_of(measured(what.model, moves, known))
    if "settles" not in known and (fit is None or leaves_pace_open(fit)):
        known["settles"] = what.model.settles
        what.untold["settles"] = (
            "all legs are about as long, so it cannot be told from the pace: the rest is found as if it"
            f" were {what.model.settles:g} s"
        )
        fit = fit_of(measured(what.model, moves, known))
    fit, shapes = _with_shapes(what, moves, known, fit)
    below = _less_than_none(fit, known) if "acceleration" in shapes else {}
    if below:  # what else was found counts with that: without it all else is otherwise
        known |= dict.fromkeys(below, 0.0)
        fit, shapes = _with_shapes(what, moves, known, fit_of(measured(what.model, moves, known)))
    if fit is None or fit.spare < SPARE:
        for name in (*PARAMETERS, "spread"):
            what.untold.setdefault(name, too_few(len(moves), "flown command", SPARE + 4))
        return
    free = [name for name in PARAMETERS if name not in known]
    kept = [one for one, off in zip(moves, fit.residuals, strict=True) if off is not None]
    values = zip((*free, *shapes), fit.values, strict=True)
    for name, estimate in (*values, *below.items()):
        kind, called = _FROM[name] if name in _FROM else SHAPES[name]
        count = sum(one.what == kind for one in kept)
        what.found[name] = Found(estimate=estimate, count=count, of=called)
    legs = sum(one.what == LEG for one in kept)
    if legs < SPARE + 2:
        what.untold["spread"] = too_few(legs, "leg", SPARE + 2)
    else:
        what.found["spread"] = Found(estimate=fit.spreads[LEG], count=legs, of="leg")
    what.far_off += fit.left_out
    _compare(what, "category", moves, fit)
    _compare(what, "drone", moves, fit)
    if "settles" in what.found:
        flown = what.model
        for name in shapes:
            flown = with_value(flown, name, what.found[name].value)
        _look_at_short_legs(what, flown, moves, known)


def _known(what: Calibration, moves: Sequence[Command]) -> dict[str, float]:
    """Return the parameters that cannot be found, with what they count as."""
    known: dict[str, float] = {}
    for name, (kind, called) in _FROM.items():
        count = sum(one.what == kind for one in moves)
        least = SPARE if kind == LEG else 3
        if count < least:
            what.untold[name] = too_few(count, called, least)
            known[name] = getattr(what.model, name) if kind == LEG else 0.0
    return known


def _with_shapes(
    what: Calibration, moves: Sequence[Command], known: Mapping[str, float], plain: Fit | None
) -> tuple[Fit | None, tuple[str, ...]]:
    """Return a fit with what shapes legs, where drones speed up and brake, and the names of that."""
    if not what.model.acceleration or "pace" in known:
        return plain, ()
    return shaped(what, moves, known, plain)


def _less_than_none(fit: Fit | None, known: Mapping[str, float]) -> dict[str, Estimate]:
    """Return the overheads that were found to be less than none by more than chance, as legs are not as modelled."""
    free = [name for name in PARAMETERS if name not in known]
    found = {} if fit is None else dict(zip(free, fit.values, strict=False))
    return {
        name: one for name, one in found.items() if name != "pace" and one.interval(SURE)[1] < 0
    }


def _compare(what: Calibration, key: str, commands: Sequence[Command], fit: Fit) -> None:
    """Note what drones of a kind differ from all by more than chance: `[motion]` is for the whole fleet."""
    groups: dict[str, list[tuple[float, Spread]]] = {}
    for one, off in zip(commands, fit.residuals, strict=True):
        if off is not None:
            groups.setdefault(getattr(one, key), []).append((off, fit.spreads[one.what]))
    for name, residuals in sorted(groups.items()) if len(groups) > 1 else ():
        differs = _differs(residuals, fit.spare, len(groups))
        if differs:
            whole = "than the whole fleet, for which [motion] holds"
            what.notes.append(f"{key} {quoted(name)} takes {differs} {whole}")


def _look_at_short_legs(
    what: Calibration, model: Motion, moves: Sequence[Command], known: Mapping[str, float]
) -> None:
    """Note that short legs take something besides, as a drone does that overshoots when it is hurried."""
    lengths = sorted(one.metres for one in moves if one.what == LEG)
    fits = [
        (length, fit.values[-1])
        for length in {lengths[len(lengths) * part // 8] for part in _SHORT}
        if (fit := fit_of(measured(model, moves, known, short=length))) and fit.spare >= SPARE
    ]
    if not fits:
        return
    short, more = max(fits, key=lambda fit: abs(fit[1].value) / fit[1].error)
    error = student(1 - CHANCE / 2 / len(_SHORT), more.spare) * more.error
    if abs(more.value) > error:
        than = "longer" if more.value > 0 else "shorter"
        what.notes.append(
            f"legs of less than {short:.1f} m take {abs(more.value):.2f} s ± {error:.2f} s {than} than pace"
            " and settles explain, which are alike for all legs"
        )


def _differs(residuals: Sequence[tuple[float, Spread]], spare: int, groups: int) -> str:
    """Return by how much some commands are off on average, if that is more than chance."""
    deviation = sqrt(sum(spread.value**2 for _, spread in residuals)) / len(residuals)
    error = student(1 - CHANCE / 2 / groups, spare) * deviation
    mean = fmean(off for off, _ in residuals)
    if abs(mean) <= error:
        return ""
    return f"{abs(mean):.1%} ± {error:.1%} {'longer' if mean > 0 else 'shorter'}"


def find_actions(what: Calibration, done: Sequence[Command]) -> None:
    """Find how much actions vary, each kind around its own mean."""
    kinds = sorted({one.action for one in done})
    rows = [Row(tuple(float(one.action == kind) for kind in kinds), one.seconds) for one in done]
    fit = fitted(rows, relative=True, finest=TICK, near=NEAR)
    if fit is None or fit.spare < SPARE:
        least = SPARE + max(len(kinds), 1)
        what.untold["action_spread"] = too_few(len(done), "built-in action", least)
        return
    what.found["action_spread"] = Found(
        estimate=fit.spreads[""], count=len(done) - fit.left_out, of="built-in action"
    )
    what.far_off += fit.left_out
    for kind, estimate in zip(kinds, fit.values, strict=True):
        low, high = estimate.interval(1 - CHANCE / len(kinds))
        planned = BUILT_IN[kind].seconds if kind in BUILT_IN else None
        if planned is not None and not low <= planned <= high:
            what.notes.append(
                f"{kind} takes {estimate.value:.2f} s ± {(high - low) / 2:.2f} s, and plans count with"
                f" {planned:g} s"
            )


STEP = 1e-5
"""What the batteries of a journal are rounded to."""
LITTLE = 0.01
"""How far off a flight, as a share of a battery, is never left out."""
FULL = 0.985
CHARGED = 0.02
"""Shares of a battery: one that is full does not tell when it was; what must have been charged."""
BESIDE = 0.3
"""Metres from where it landed, up to which a drone counts as not carried elsewhere."""


def find_battery(what: Calibration, runs: Sequence[Sequence[Command]]) -> None:
    """Find what a flight takes of a battery, and how long that takes to be charged."""
    flights = [Row((share,), used) for run in runs for share, used in _flights(run)]
    fit = fitted(flights, relative=False, finest=STEP, near=LITTLE)
    _keep(what, "drain", fit, "flight", len(flights))
    charges = [
        Row((expected,), took) for run in runs for expected, took in _charges(run, what.model.taper)
    ]
    fit = fitted(charges, relative=True, finest=TICK, near=NEAR)
    _keep(what, "charge", fit, "charge", len(charges))


def _keep(what: Calibration, name: str, fit: Fit | None, of: str, count: int) -> None:
    """Keep the factor that was fitted, if it was."""
    if fit is None or fit.spare < SPARE:
        what.untold[name] = too_few(count, f"whole {of}", SPARE + 1)
        return
    what.found[name] = Found(estimate=fit.values[0], count=count - fit.left_out, of=of)


def _by_drone(run: Iterable[Command]) -> Iterator[list[Command]]:
    drones: dict[str, list[Command]] = {}
    for one in run:
        drones.setdefault(one.drone, []).append(one)
    yield from drones.values()


def _flights(run: Sequence[Command]) -> Iterator[tuple[float, float]]:
    """Yield of each flight its share of the flight time, hovering to hovering, and what it used."""
    for commands in _by_drone(run):
        rise: Command | None = None
        for one in commands:
            if one.what == TAKE_OFF:
                rise = one if one.ended == DONE else None
            elif one.ended not in (DONE, BROKEN_OFF):
                rise = None
            elif one.what == LAND:
                if rise is not None and one.ended == DONE and rise.flight_time > 0:
                    share = (one.began - rise.ended_at) / rise.flight_time
                    yield share, rise.battery[1] - one.battery[0]
                rise = None


def _charges(run: Sequence[Command], taper: float) -> Iterator[tuple[float, float]]:
    """Yield of each charge how long it should take, and how long it took."""
    for commands in _by_drone(run):
        for down, up in pairwise(commands):
            if (down.what, down.ended, up.what) != (LAND, DONE, TAKE_OFF) or up.charge_time <= 0:
                continue
            level = down.battery[1]
            after = up.battery[0]
            if after > FULL or after - level < CHARGED or dist(down.end, up.start) > BESIDE:
                continue
            yield charging(level, after, up.charge_time, taper), up.began - down.ended_at


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
            interval=(max(planned + low, 0.0), planned + high),
            count=len(those),
            planned=planned,
            parameter=plan.get("parameter"),
        )
        what.own.append(found)
        if not low <= 0.0 <= high and _in_app(found.seconds) != _in_app(planned):
            what.notes.append(_note(found, off.value, (high - low) / 2, several))


def _planned(name: str, plan: Mapping[str, Any]) -> Action:
    """Return the action, as far as it says how long it takes."""
    parameter = plan.get("parameter")
    seconds = plan["seconds"]
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


def calibrated(journals: Sequence[Flights], model: Motion) -> Calibration:
    """Fit what can be fitted; `model` says how legs are flown, and what is not found."""
    what = Calibration(model=model)
    commands = [one for journal in journals for one in journal.commands]
    done = [one for one in commands if one.ended == DONE]
    what.commands = len(commands)
    what.broken_off = sum(one.ended == BROKEN_OFF for one in commands)
    what.failed = len(commands) - len(done) - what.broken_off
    find_durations(what, done)
    find_actions(what, [one for one in done if one.what == ACTION])
    runs = [run for journal in journals for run in journal.runs]
    find_battery(what, runs)
    find_own_actions(what, journals)
    what.bound()
    return what
