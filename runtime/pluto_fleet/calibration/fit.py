"""How drones move, fitted to their commands, and what of `Motion` can be found.

A command takes F · (pace · what its way takes + its overheads), with a factor F of its own, around 1. What
flights take of a battery, and how long it takes to charge it, are fitted to the telemetry around them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
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
    WIDEST,
    ActionTime,
    Calibration,
    Estimate,
    Fit,
    Found,
    Rate,
    Row,
    fitted,
    student,
    too_few,
)

TICK = 1e-4
"""What the seconds of a journal are rounded to."""
NEAR = 0.05
"""How far off a duration or a charge, as a share of it, is never left out: so it may be with drones that are well."""
MOVED = 0.01
"""Metres from which on a leg counts: a drone that is there already need not fly."""
CHANCE = 0.001
"""How probable a difference may be by chance to be noted."""
_SHORT = (1, 2, 3, 4)
"""How many eighths of all legs may be the short ones."""
_PARAMETERS = ("pace", "settles", "take_off", "landing")
_FROM = {
    "pace": (LEG, "leg"),
    "settles": (LEG, "leg"),
    "take_off": (TAKE_OFF, "take-off"),
    "landing": (LAND, "landing"),
}
"""From which commands each is found, and what people call these."""
_OVERHEAD = {TAKE_OFF: "take_off", LAND: "landing"}
"""What such a command takes that no other does."""
_SHAPES = {
    "acceleration": (LEG, "leg"),
    "down": (LAND, "landing"),
    "up": (TAKE_OFF, "take-off"),
    "touch_down": (LAND, "landing"),
    "jerk": (LEG, "leg"),
}
"""On which a duration depends otherwise than in proportion, where drones speed up and brake; from which commands."""
_VARIED = 1.2
"""How much longer the longest of these must be than the shortest."""
_ROUNDS = 12
"""Of fits to what was found in the one before."""
_BOLD = 3
"""Of these rounds, those in which a value is changed to what was found, and not half as far."""
_STARTS = (1.0, 0.6, 1.6)
"""Times what is said of the acceleration: from where it is looked for."""
_SETTLED = 1e-3
"""By what share a value changes from one round to the next, once it is found."""
_FURTHEST = 2.0
"""By what factor it may change from one round to the next."""
_STEP = 1e-3
"""By what share a value is changed to see how durations change with it."""


def find_durations(what: Calibration, done: Sequence[Command]) -> None:
    """Find pace, overheads and spread from all commands that move a drone."""
    moves = [one for one in done if one.what != ACTION and one.metres >= MOVED]
    known = _known(what, moves)
    moves = [one for one in moves if _OVERHEAD.get(one.what) not in known]
    fit = _fit_of(what.model, moves, known)
    if "settles" not in known and (fit is None or _leaves_pace_open(fit)):
        known["settles"] = what.model.settles
        what.untold["settles"] = (
            "all legs are about as long, so it cannot be told from the pace: the rest is found as if it"
            f" were {what.model.settles:g} s"
        )
        fit = _fit_of(what.model, moves, known)
    shapes: tuple[str, ...] = ()
    if what.model.acceleration and "pace" not in known:
        fit, shapes = _shaped(what, moves, known, fit)
    if fit is None or fit.spread.spare < SPARE:
        for name in (*_PARAMETERS, "spread"):
            what.untold.setdefault(name, too_few(len(moves), "flown command", SPARE + 4))
        return
    free = [name for name in _PARAMETERS if name not in known]
    kept = [one for one, off in zip(moves, fit.residuals, strict=True) if off is not None]
    for name, estimate in zip((*free, *shapes), fit.values, strict=True):
        kind, called = _FROM[name] if name in _FROM else _SHAPES[name]
        count = sum(one.what == kind for one in kept)
        what.found[name] = Found(estimate=estimate, count=count, of=called)
    what.found["spread"] = Found(estimate=fit.spread, count=len(kept), of="flown command")
    what.far_off += fit.left_out
    _compare(what, "category", moves, fit)
    _compare(what, "drone", moves, fit)
    if "settles" in what.found:
        flown = what.model
        for name in shapes:
            flown = _with(flown, name, what.found[name].value)
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


def _shaped(
    what: Calibration, moves: Sequence[Command], known: Mapping[str, float], plain: Fit | None
) -> tuple[Fit | None, tuple[str, ...]]:
    """Find also what of their shape the legs, climbs and landings tell; the rest counts as said."""
    fit: Fit | None = None
    shapes = [name for name in _SHAPES if getattr(what.model, name) and _vary(name, moves)]
    while shapes:
        fit = _bent(what.model, moves, known, shapes)
        if fit is None:
            least = _unknown(what.model, moves, known, shapes) or shapes[-1]
        else:
            widths = _widths(fit, len(shapes))
            least = shapes[widths.index(max(widths))]
            if max(widths) < WIDEST["shape"] and not _leaves_pace_open(fit):
                break
        # one that cannot be told spoils all: of legs that is their jerk before their acceleration
        shapes.remove("jerk" if least == "acceleration" and "jerk" in shapes else least)
    others = [name for name in shapes if name != "acceleration"]
    if others != shapes:
        without = _bent(what.model, moves, known, others) if others else plain
        if fit is None or (without is not None and _order(without) <= _order(fit)):
            fit = without  # no leg is long enough to tell it: what is said explains as much
            shapes = others
    for name in _SHAPES:
        if getattr(what.model, name) and name not in shapes:
            said = f"{getattr(what.model, name):g}"
            what.untold[name] = (
                f"the {_SHAPES[name][1]}s leave it open: the rest is found as if it were {said}"
            )
    return (fit if shapes else plain), tuple(shapes)


def _vary(name: str, moves: Sequence[Command]) -> bool:
    """Return whether commands that a value shapes are short and long enough to tell it, were all else known."""
    metres = [one.metres for one in moves if one.what == _SHAPES[name][0]]
    return len(metres) > SPARE and max(metres) > _VARIED * min(metres)


def _unknown(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], shapes: Sequence[str]
) -> str | None:
    """Return one of these that could not even be told if all others were as is said."""
    for name in shapes:
        if _bent(model, moves, known, [name]) is None:
            return name
    return None


def _widths(fit: Fit, shapes: int) -> list[float]:
    """Return half the interval of each of the last values, as a share of it."""
    found = [(one.value, one.interval(SURE)) for one in fit.values[-shapes:]]
    return [(high - low) / 2 / abs(value) for value, (low, high) in found]


def _bent(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], shapes: Sequence[str]
) -> Fit | None:
    """Fit also these values of the model, the last ones; None: they cannot be told.

    Where all legs would be long ones by what is said, they are not by another acceleration.
    """
    fits = []
    for factor in _STARTS if "acceleration" in shapes else (1.0,):
        begun = replace(model, acceleration=factor * model.acceleration)
        fit = _followed(begun, moves, known, shapes)
        fits += [] if fit is None else [fit]
    return min(fits, key=_order, default=None)


def _order(fit: Fit) -> float:
    """Return how badly a fit explains what was measured: what it leaves out counts, too."""
    return fit.spread.value * (1 + fit.left_out / (fit.spread.spare + fit.left_out))


def _followed(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], shapes: Sequence[str]
) -> Fit | None:
    """Fit these values by how durations change with them, from what the model has; None: it leads nowhere."""
    pace = 1.0
    for turn in range(_ROUNDS):
        fit = _fit_of(model, moves, known, shapes=shapes, pace=pace)
        if fit is None:
            return None
        pace = fit.values[0].value
        inverse = fit.values[-len(shapes) :]
        found = dict(zip(shapes, inverse, strict=True))
        if all(_is_near(1 / getattr(model, name), one) for name, one in found.items()):
            rates = tuple(Rate.of(one) for one in inverse)
            return replace(fit, values=(*fit.values[: -len(shapes)], *rates))
        for name, one in found.items():
            was = getattr(model, name)
            now = 1 / max(one.value, 1 / was / _FURTHEST)
            # a value that is found too far on either side in turn is between them
            model = _with(model, name, now if turn < _BOLD else sqrt(was * now))
    return None


def _is_near(tried: float, found: Estimate) -> bool:
    """Return whether a value was found where durations were compared with it."""
    return abs(found.value - tried) < max(_SETTLED * tried, found.error / 10)


def _fit_of(
    model: Motion,
    moves: Sequence[Command],
    known: Mapping[str, float],
    *,
    short: float = 0.0,
    shapes: Sequence[str] = (),
    pace: float = 1.0,
) -> Fit | None:
    """Fit what is not known; with `short`, also what shorter legs take besides, as the last value.

    `shapes`: values of the model whose inverses are fitted near what it has, at this pace, as the last ones: a
    duration is nearly in proportion to these.
    """
    plain = replace(model, pace=1.0, settles=0.0, take_off=0.0, landing=0.0)
    free = [at for at, name in enumerate(_PARAMETERS) if name not in known]
    rows = []
    for one in moves:
        factors = _factors(plain, one)
        given = sum(factors[at] * known.get(name, 0.0) for at, name in enumerate(_PARAMETERS))
        besides = [float(one.what == LEG and one.metres < short)] if short else []
        for name in shapes:
            slope = pace * _slope(plain, one, name)
            given -= slope / getattr(plain, name)
            besides.append(slope)
        rows.append(Row((*[factors[at] for at in free], *besides), one.seconds, given))
    return fitted(rows, relative=True, finest=TICK, near=NEAR)


def _slope(plain: Motion, one: Command, name: str) -> float:
    """Return by how much a command takes longer for each unit that the inverse of a value is larger."""
    inverse: float = 1 / getattr(plain, name)
    step = _STEP * inverse
    more = _factors(_with(plain, name, 1 / (inverse + step)), one)[0]
    less = _factors(_with(plain, name, 1 / (inverse - step)), one)[0]
    return (more - less) / (2 * step)


def _with(model: Motion, name: str, value: float) -> Motion:
    """Return a model with another value of this name."""
    changed: dict[str, Any] = {name: value}
    return replace(model, **changed)


def _factors(plain: Motion, one: Command) -> tuple[float, float, float, float]:
    """Return how often a command takes each of the parameters."""
    match one.what:
        case "take_off":
            return plain.climb(one.metres, one.speed), 1.0, 1.0, 0.0
        case "land":
            return plain.sink(one.metres, one.speed), 0.0, 0.0, 1.0
        case _:
            return plain.leg(one.metres, one.speed), 1.0, 0.0, 0.0


def _leaves_pace_open(fit: Fit) -> bool:
    """Return whether pace and settling cannot be told apart, as all legs are alike."""
    if fit.spread.spare < SPARE:
        return False
    low, high = fit.values[0].interval(SURE)
    return (high - low) / 2 > WIDEST["pace"] * abs(fit.values[0].value)


def _compare(what: Calibration, key: str, commands: Sequence[Command], fit: Fit) -> None:
    """Note what drones of a kind differ from all by more than chance: `[motion]` is for the whole fleet."""
    groups: dict[str, list[float]] = {}
    for one, off in zip(commands, fit.residuals, strict=True):
        if off is not None:
            groups.setdefault(getattr(one, key), []).append(off)
    for name, residuals in sorted(groups.items()) if len(groups) > 1 else ():
        differs = _differs(residuals, fit, len(groups))
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
        if (fit := _fit_of(model, moves, known, short=length)) and fit.spread.spare >= SPARE
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


def _differs(residuals: Sequence[float], fit: Fit, groups: int) -> str:
    """Return by how much some commands are off on average, if that is more than chance."""
    if not residuals:
        return ""
    spare = fit.spread.spare
    deviation = fit.spread.value
    error = student(1 - CHANCE / 2 / groups, spare) * deviation / sqrt(len(residuals))
    mean = fmean(residuals)
    if abs(mean) <= error:
        return ""
    return f"{abs(mean):.1%} ± {error:.1%} {'longer' if mean > 0 else 'shorter'}"


def find_actions(what: Calibration, done: Sequence[Command]) -> None:
    """Find how much actions vary, each kind around its own mean."""
    kinds = sorted({one.action for one in done})
    rows = [Row(tuple(float(one.action == kind) for kind in kinds), one.seconds) for one in done]
    fit = fitted(rows, relative=True, finest=TICK, near=NEAR)
    if fit is None or fit.spread.spare < SPARE:
        least = SPARE + max(len(kinds), 1)
        what.untold["action_spread"] = too_few(len(done), "built-in action", least)
        return
    what.found["action_spread"] = Found(
        estimate=fit.spread, count=len(done) - fit.left_out, of="built-in action"
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
    if fit is None or fit.spread.spare < SPARE:
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
