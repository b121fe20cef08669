"""How long drones take, fitted to their commands: pace, overheads and how much all that varies.

A command takes F · (pace · what its way takes + its overheads), with a factor F of its own, around 1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import sqrt
from statistics import fmean
from typing import TYPE_CHECKING

from ..jobs.flown import ACTION, LAND, LEG, TAKE_OFF
from ..shared.domain.actions import BUILT_IN
from ..shared.domain.text import quoted
from .estimates import Fit, Row, fitted, student
from .found import SPARE, SURE, WIDEST, Calibration, Found, too_few

if TYPE_CHECKING:
    from ..shared.domain.motion import Motion
    from .commands import Command

TICK = 1e-4
"""What the seconds of a journal are rounded to."""
NEAR = 0.05
"""How far off a duration, as a share of it, is never left out: so it may be with drones that are well."""
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
    if fit is None or fit.spread.spare < SPARE:
        for name in (*_PARAMETERS, "spread"):
            what.untold.setdefault(name, too_few(len(moves), "flown command", SPARE + 4))
        return
    free = [name for name in _PARAMETERS if name not in known]
    kept = [one for one, off in zip(moves, fit.residuals, strict=True) if off is not None]
    for name, estimate in zip(free, fit.values, strict=True):
        kind, called = _FROM[name]
        count = sum(one.what == kind for one in kept)
        what.found[name] = Found(estimate=estimate, count=count, of=called)
    what.found["spread"] = Found(estimate=fit.spread, count=len(kept), of="flown command")
    what.far_off += fit.left_out
    _compare(what, "category", moves, fit)
    _compare(what, "drone", moves, fit)
    if "settles" in what.found:
        _look_at_short_legs(what, moves, known)


def _known(what: Calibration, moves: Sequence[Command]) -> dict[str, float]:
    """Return the parameters that cannot be found, with what they count as."""
    known: dict[str, float] = {}
    for name, (kind, called) in _FROM.items():
        count, least = sum(one.what == kind for one in moves), SPARE if kind == LEG else 3
        if count < least:
            what.untold[name] = too_few(count, called, least)
            known[name] = getattr(what.model, name) if kind == LEG else 0.0
    return known


def _fit_of(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], *, short: float = 0.0
) -> Fit | None:
    """Fit what is not known; with `short`, also what shorter legs take besides, as the last value."""
    plain = replace(model, pace=1.0, settles=0.0, take_off=0.0, landing=0.0)
    free = [at for at, name in enumerate(_PARAMETERS) if name not in known]
    rows = []
    for one in moves:
        factors = _factors(plain, one)
        given = sum(factors[at] * known.get(name, 0.0) for at, name in enumerate(_PARAMETERS))
        besides = (float(one.what == LEG and one.metres < short),) if short else ()
        rows.append(Row((*[factors[at] for at in free], *besides), one.seconds, given))
    return fitted(rows, relative=True, finest=TICK, near=NEAR)


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
    what: Calibration, moves: Sequence[Command], known: Mapping[str, float]
) -> None:
    """Note that short legs take something besides, as a drone does that overshoots when it is hurried."""
    lengths = sorted(one.metres for one in moves if one.what == LEG)
    fits = [
        (length, fit.values[-1])
        for length in {lengths[len(lengths) * part // 8] for part in _SHORT}
        if (fit := _fit_of(what.model, moves, known, short=length)) and fit.spread.spare >= SPARE
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
    spare, deviation = fit.spread.spare, fit.spread.value
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
