"""What each command of a drone takes by the model, as a measurement of the values of `[motion]`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ..jobs.flown import LAND, LEG, TAKE_OFF
from ..shared.domain.motion import Motion
from .commands import Command
from .estimates import SPARE, SURE, WIDEST, Fit, Row, fitted

TICK = 1e-4
"""What the seconds of a journal are rounded to."""
NEAR = 0.05
"""How far off a duration or a charge, as a share of it, is never left out: so it may be with drones that are well."""
PARAMETERS = ("pace", "settles", "take_off", "landing")
OVERHEAD = {TAKE_OFF: "take_off", LAND: "landing"}
"""What such a command takes that no other does."""
_STEP = 1e-3
"""By what share a value is changed to see how durations change with it."""


def fit_of(rows: Iterable[Row]) -> Fit | None:
    """Fit what is not known to what commands tell of it, as `measured` yields that."""
    return fitted([*rows], relative=True, finest=TICK, near=NEAR)


def measured(
    model: Motion,
    moves: Sequence[Command],
    known: Mapping[str, float],
    *,
    short: float = 0.0,
    shapes: Sequence[str] = (),
    pace: float = 1.0,
) -> Iterator[Row]:
    """Yield what each command tells of what is not known; with `short`, also what shorter legs take besides, at last.

    `shapes`: values of the model whose inverses are looked for near what it has, at this pace, as the last ones: a
    duration is nearly in proportion to these.
    """
    plain = replace(model, pace=1.0, settles=0.0, take_off=0.0, landing=0.0)
    free = [at for at, name in enumerate(PARAMETERS) if name not in known]
    around = [_around(plain, name) for name in shapes]
    for one in moves:
        way = _way(plain, one)
        factors = (way, float(one.what != LAND), *(float(one.what == what) for what in OVERHEAD))
        given = sum(factors[at] * known.get(name, 0.0) for at, name in enumerate(PARAMETERS))
        besides = [float(one.what == LEG and one.metres < short)] if short else []
        for inverse, step, more, less in around:
            slope = pace * (_way(more, one) - _way(less, one)) / (2 * step)
            given -= slope * inverse
            besides.append(slope)
        yield Row((*[factors[at] for at in free], *besides), one.seconds, given, one.what)


def _around(plain: Motion, name: str) -> tuple[float, float, Motion, Motion]:
    """Return the inverse of a value, a small step of it, and the model with the inverse that much more and less."""
    inverse: float = 1 / getattr(plain, name)
    step = _STEP * inverse
    more = with_value(plain, name, 1 / (inverse + step))
    less = with_value(plain, name, 1 / (inverse - step))
    return inverse, step, more, less


def with_value(model: Motion, name: str, value: float) -> Motion:
    """Return a model with another value of this name."""
    changed: dict[str, Any] = {name: value}
    return replace(model, **changed)


def _way(plain: Motion, one: Command) -> float:
    """Return the seconds of a command's way."""
    match one.what:
        case "take_off":
            return plain.climb(one.metres, one.speed)
        case "land":
            return plain.sink(one.metres, one.speed)
        case _:
            return max(plain.leg(one.metres, one.speed), plain.descent(one.start, one.end))


def leaves_pace_open(fit: Fit) -> bool:
    """Return whether pace and settling cannot be told apart, as all legs are alike."""
    if fit.spare < SPARE:
        return False
    low, high = fit.values[0].interval(SURE)
    return (high - low) / 2 > WIDEST["pace"] * abs(fit.values[0].value)
