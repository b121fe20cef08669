"""How drones move, fitted to the commands that they flew: the factors and overheads of `Motion`.

A command takes F · (pace · what its way takes + its overheads), with a factor F of its own, around 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import dist, inf, sqrt
from statistics import fmean
from typing import TYPE_CHECKING

from ..jobs.flown import ACTION, BROKEN_OFF, DONE, LAND, LEG, TAKE_OFF
from ..shared.domain.actions import BUILT_IN
from ..shared.domain.motion import charging
from ..shared.domain.text import counted, quoted
from .estimates import Estimate, Fit, Row, fitted, student

if TYPE_CHECKING:
    from ..shared.domain.motion import Motion
    from .commands import Command, Flights

SURE = 0.95
"""The probability with which all intervals hold, all of them at once."""
SPARE = 5
"""How many measurements there must be more than parameters."""
TICK, STEP = 1e-4, 1e-5
"""What the seconds and the batteries of a journal are rounded to."""
MOVED = 0.01
"""Metres from which on a leg counts: a drone that is there already need not fly."""
FULL, CHARGED = 0.985, 0.02
"""Shares of a battery: one that is full does not tell when it was; what must have been charged."""
BESIDE = 0.3
"""Metres from where it landed, up to which a drone counts as not carried elsewhere."""
WIDEST = {"pace": 0.2, "drain": 0.5, "charge": 0.5}
"""Half an interval from which on a value says nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """A value, and from how many of what it was found."""

    estimate: Estimate
    count: int
    of: str
    low: float = 0.0
    high: float = 0.0
    """Its interval."""

    @property
    def value(self) -> float:
        """What was found; no overhead is less than none."""
        return max(self.estimate.value, 0.0)


@dataclass(slots=True, kw_only=True)
class Calibration:
    """What journals tell of a fleet."""

    model: Motion
    """How it is said to move."""
    found: dict[str, Found] = field(default_factory=dict)
    """By the keys of `[motion]`, and `charge`: the share of `charge_time` that a charge takes."""
    untold: dict[str, str] = field(default_factory=dict)
    """What could not be told, and why."""
    notes: list[str] = field(default_factory=list)
    """What does not fit into `[motion]`."""
    commands: int = 0
    broken_off: int = 0
    failed: int = 0
    far_off: int = 0


def calibrated(journals: Sequence[Flights], model: Motion) -> Calibration:
    """Fit what can be fitted; `model` says how legs are flown, and what is not found."""
    what = Calibration(model=model)
    commands = [one for journal in journals for one in journal.commands]
    done = [one for one in commands if one.ended == DONE]
    what.commands = len(commands)
    what.broken_off = sum(one.ended == BROKEN_OFF for one in commands)
    what.failed = len(commands) - len(done) - what.broken_off
    _durations(what, done)
    _actions(what, [one for one in done if one.what == ACTION])
    runs = [run for journal in journals for run in journal.runs]
    _battery(what, runs)
    _bounded(what)
    return what


def _bounded(what: Calibration) -> None:
    """Give each value its interval, so that all hold at once; drop those that say nothing."""
    while what.found:
        level = 1 - (1 - SURE) / len(what.found)
        for name, found in what.found.items():
            low, high = found.estimate.interval(level)
            what.found[name] = replace(found, low=max(low, 0.0), high=high)
        vague = {
            name: found
            for name, found in what.found.items()
            if (found.high - found.low) / 2 > WIDEST.get(name, inf)
        }
        if not vague:
            return
        for name, found in vague.items():
            del what.found[name]
            what.untold[name] = f"{_from(found)} leave it open"


def _from(found: Found) -> str:
    return counted(found.count, found.of)


# Durations

_PARAMETERS = ("pace", "settles", "take_off", "landing")
_NEEDS = {"take_off": (TAKE_OFF, "take-off"), "landing": (LAND, "landing")}


def _durations(what: Calibration, done: Sequence[Command]) -> None:
    """Find pace, overheads and spread from all commands that move a drone."""
    moves = [one for one in done if one.what != ACTION and one.metres >= MOVED]
    counts = {kind: sum(one.what == kind for one in moves) for kind in (LEG, TAKE_OFF, LAND)}
    known: dict[str, float] = {}
    for name, (kind, called) in _NEEDS.items():
        if counts[kind] < 3:
            what.untold[name] = _few(counts[kind], called, 3)
            moves = [one for one in moves if one.what != kind]
            known[name] = 0.0
    if counts[LEG] < SPARE:
        for name in ("pace", "settles"):
            what.untold[name] = _few(counts[LEG], "leg", SPARE)
            known[name] = getattr(what.model, name)
    fit = _fit_of(what.model, moves, known)
    if fit is not None and _is_vague(
        fit, known
    ):  # all legs are alike: one of the two must be known
        known["settles"] = what.model.settles
        what.untold["settles"] = (
            "all legs are about as long, so it cannot be told from the pace: the rest is found as if it"
            f" were {what.model.settles:g} s"
        )
        fit = _fit_of(what.model, moves, known)
    if fit is None or fit.spread.spare < SPARE:
        for name in (*_PARAMETERS, "spread"):
            what.untold.setdefault(name, _few(len(moves), "flown command", SPARE + 4))
        return
    free = [name for name in _PARAMETERS if name not in known]
    kept = [one for one, off in zip(moves, fit.residuals, strict=True) if off is not None]
    for name, estimate in zip(free, fit.values, strict=True):
        kind, called = _NEEDS.get(name, (LEG, "leg"))
        count = sum(one.what == kind for one in kept)
        what.found[name] = Found(estimate=estimate, count=count, of=called)
    what.found["spread"] = Found(estimate=fit.spread, count=len(kept), of="flown command")
    what.far_off += fit.left_out
    _compare(what, "category", "of category", moves, fit)
    _compare(what, "drone", "of drone", moves, fit)


def _fit_of(model: Motion, moves: Sequence[Command], known: Mapping[str, float]) -> Fit | None:
    """Fit what is not known."""
    plain = replace(model, pace=1.0, settles=0.0, take_off=0.0, landing=0.0)
    free = [at for at, name in enumerate(_PARAMETERS) if name not in known]
    rows = []
    for one in moves:
        factors = _factors(plain, one)
        given = sum(factors[at] * known.get(name, 0.0) for at, name in enumerate(_PARAMETERS))
        rows.append(Row(tuple(factors[at] for at in free), one.seconds, given))
    return fitted(rows, relative=True, finest=TICK)


def _factors(plain: Motion, one: Command) -> tuple[float, float, float, float]:
    """Return how often a command takes each of the parameters."""
    match one.what:
        case "take_off":
            return plain.climb(one.metres, one.speed), 1.0, 1.0, 0.0
        case "land":
            return plain.sink(one.metres, one.speed), 0.0, 0.0, 1.0
        case _:
            return plain.leg(one.metres, one.speed), 1.0, 0.0, 0.0


def _is_vague(fit: Fit, known: Mapping[str, float]) -> bool:
    """Return whether pace and settling cannot be told apart."""
    if "settles" in known or fit.spread.spare < SPARE:
        return False
    low, high = fit.values[0].interval(SURE)
    return (high - low) / 2 > WIDEST["pace"]


def _few(count: int, called: str, least: int) -> str:
    return f"it takes {least} {called}s at least, and there are {count}"


def _compare(
    what: Calibration, key: str, whose: str, commands: Sequence[Command], fit: Fit
) -> None:
    """Note the drones that differ from the others by more than chance: `[motion]` is for all."""
    groups: dict[str, list[float]] = {}
    for one, off in zip(commands, fit.residuals, strict=True):
        if off is not None:
            groups.setdefault(getattr(one, key), []).append(off)
    if len(groups) < 2:
        return
    reach = student(1 - (1 - SURE) / 2 / len(groups), fit.spread.spare) * fit.spread.value
    for name, residuals in sorted(groups.items()):
        mean, error = fmean(residuals), reach / sqrt(len(residuals))
        if abs(mean) > error:
            than = "longer" if mean > 0 else "shorter"
            what.notes.append(
                f"what drones {whose} {quoted(name)} fly takes {abs(mean):.1%} ± {error:.1%} {than} than"
                " of all together, which is more than chance: [motion] holds for the whole fleet"
                if key == "category"
                else f"{quoted(name)} takes {abs(mean):.1%} ± {error:.1%} {than} than all drones together,"
                " which is more than chance: look at its battery, its propellers and its load"
            )


# Actions


def _actions(what: Calibration, done: Sequence[Command]) -> None:
    """Find how much actions vary, each kind around its own mean."""
    kinds = sorted({one.action for one in done})
    rows = [Row(tuple(float(one.action == kind) for kind in kinds), one.seconds) for one in done]
    fit = fitted(rows, relative=True, finest=TICK)
    if fit is None or fit.spread.spare < SPARE:
        least = SPARE + max(len(kinds), 1)
        what.untold["action_spread"] = _few(len(done), "built-in action", least)
        return
    what.found["action_spread"] = Found(
        estimate=fit.spread, count=len(done) - fit.left_out, of="built-in action"
    )
    what.far_off += fit.left_out
    for kind, estimate in zip(kinds, fit.values, strict=True):
        low, high = estimate.interval(1 - (1 - SURE) / len(kinds))
        planned = BUILT_IN[kind].seconds if kind in BUILT_IN else None
        if planned is not None and not low <= planned <= high:
            what.notes.append(
                f"{kind} takes {estimate.value:.2f} s ± {(high - low) / 2:.2f} s, and plans count with"
                f" {planned:g} s"
            )


# The battery


def _battery(what: Calibration, runs: Sequence[Sequence[Command]]) -> None:
    """Find what a flight takes of a battery, and how long that takes to be charged."""
    flights = [Row((share,), used) for run in runs for share, used in _flights(run)]
    _factor_found(what, "drain", flights, "flight", relative=False, finest=STEP)
    charges = [
        Row((expected,), took) for run in runs for expected, took in _charges(run, what.model.taper)
    ]
    _factor_found(what, "charge", charges, "charge", relative=True, finest=TICK)


def _factor_found(
    what: Calibration, name: str, rows: Sequence[Row], of: str, *, relative: bool, finest: float
) -> None:
    fit = fitted(rows, relative=relative, finest=finest)
    if fit is None or fit.spread.spare < SPARE:
        what.untold[name] = _few(len(rows), f"whole {of}", SPARE + 1)
        return
    what.far_off += fit.left_out
    what.found[name] = Found(estimate=fit.values[0], count=len(rows) - fit.left_out, of=of)


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
            level, after = down.battery[1], up.battery[0]
            if after > FULL or after - level < CHARGED or dist(down.end, up.start) > BESIDE:
                continue
            yield charging(level, after, up.charge_time, taper), up.began - down.ended_at
