"""What shapes legs, climbs and landings, found together with all else that commands tell.

Durations depend on the inverse of each such value nearly in proportion, so Gauss and Newton's method finds them. With
an acceleration that is so only nearby: one that is twice as large may explain legs as well. So all else is found again
for accelerations to either side, as far as they explain what was measured: from that come the intervals.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import copysign, sqrt
from operator import mul

from ..jobs.flown import LAND, LEG, TAKE_OFF
from ..shared.domain.motion import Motion
from .commands import Command
from .estimates import (
    SPARE,
    WIDEST,
    Calibration,
    Estimate,
    Fit,
    Point,
    Profile,
    Rate,
    Solution,
    solve,
    sure_of_each,
)
from .moves import fit_of, leaves_pace_open, measured, with_value

ACCELERATION = "acceleration"
SHAPES = {
    ACCELERATION: (LEG, "leg"),
    "down": (LAND, "landing"),
    "up": (TAKE_OFF, "take-off"),
    "touch_down": (LAND, "landing"),
    "jerk": (LEG, "leg"),
}
"""On which a duration depends otherwise than in proportion, where drones speed up and brake; from which commands."""
_VALUES = 13
"""As many can be found where drones speed up and brake."""
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
_STEPS = 24
"""Of a walk to one side."""
_FAR = 4.5
"""Standard errors, as far as a walk leads."""
_ALIKE = 20.0
"""By what factor an acceleration may be larger or smaller that is told."""


def shaped(
    what: Calibration, moves: Sequence[Command], known: Mapping[str, float], plain: Fit | None
) -> tuple[Fit | None, tuple[str, ...]]:
    """Find also what of their shape the legs, climbs and landings tell; the rest counts as said."""
    fit = plain
    shapes = [name for name in SHAPES if getattr(what.model, name) and _vary(name, moves)]
    while shapes:
        fit = _bent(what.model, moves, known, shapes)
        if fit is None:
            least = _unknown(what.model, moves, known, shapes) or shapes[0]
        else:
            widths = _widths(fit, len(shapes))
            least = shapes[widths.index(max(widths))]
            if max(widths) < WIDEST["shape"] and not leaves_pace_open(fit):
                break
        # one that cannot be told spoils all: of legs that is their jerk before their acceleration
        shapes.remove("jerk" if least == ACCELERATION and "jerk" in shapes else least)
        fit = plain
    for name in SHAPES:
        what.untold.pop(name, None)
        if getattr(what.model, name) and name not in shapes:
            said = f"{getattr(what.model, name):g}"
            what.untold[name] = (
                f"the {SHAPES[name][1]}s leave it open: the rest is found as if it were {said}"
            )
    return fit, tuple(shapes)


def _vary(name: str, moves: Sequence[Command]) -> bool:
    """Return whether commands that a value shapes are short and long enough to tell it, were all else known."""
    metres = [one.metres for one in moves if one.what == SHAPES[name][0]]
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
    level = sure_of_each(_VALUES)
    found = [(one.value, one.interval(level)) for one in fit.values[-shapes:]]
    return [(high - low) / 2 / abs(value) for value, (low, high) in found]


def _bent(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], shapes: Sequence[str]
) -> Fit | None:
    """Fit also these values of the model, the last ones; None: they cannot be told.

    Where all legs would be long ones by what is said, they are not by another acceleration.
    """
    fits: list[tuple[Fit, Motion]] = []
    for factor in _STARTS if ACCELERATION in shapes else (1.0,):
        begun = replace(model, acceleration=factor * model.acceleration)
        followed = _followed(begun, moves, known, shapes)
        fits += [] if followed is None else [followed]
    if not fits:
        return None
    fit, found = min(fits, key=lambda one: one[0].scatter)
    values = fit.values
    if ACCELERATION in shapes:
        values = _Walk(fit, found, moves, known, shapes).profiles()
    first = len(values) - len(shapes)
    return replace(fit, values=(*values[:first], *map(Rate.of, values[first:])))


def _followed(
    model: Motion, moves: Sequence[Command], known: Mapping[str, float], shapes: Sequence[str]
) -> tuple[Fit, Motion] | None:
    """Fit the inverses of these values by how durations change with them, from what the model has.

    Return also the model with the values that were found; None: it leads nowhere.
    """
    pace = 1.0
    for turn in range(_ROUNDS):
        fit = fit_of(measured(model, moves, known, shapes=shapes, pace=pace))
        if fit is None:
            return None
        pace = fit.values[0].value
        found = dict(zip(shapes, fit.values[-len(shapes) :], strict=True))
        if all(_is_near(1 / getattr(model, name), one) for name, one in found.items()):
            return fit, replace(model, pace=pace)
        for name, one in found.items():
            was = getattr(model, name)
            now = 1 / max(one.value, 1 / was / _FURTHEST)
            # a value that is found too far on either side in turn is between them
            model = with_value(model, name, now if turn < _BOLD else sqrt(was * now))
    return None


def _is_near(tried: float, found: Estimate) -> bool:
    """Return whether a value was found where durations were compared with it."""
    return abs(found.value - tried) < max(_SETTLED * tried, found.error / 10)


@dataclass(slots=True)
class _Stop:
    """What is found for one acceleration."""

    model: Motion
    """With the values that were found."""
    solution: Solution
    squares: float
    """The weighted sum of squares."""

    @property
    def inverse(self) -> float:
        """The acceleration's."""
        return 1 / self.model.acceleration


class _Walk:
    """Goes from the acceleration that was found to either side, as long as others explain what was measured."""

    def __init__(
        self,
        fit: Fit,
        model: Motion,
        moves: Sequence[Command],
        known: Mapping[str, float],
        shapes: Sequence[str],
    ) -> None:
        self._fit = fit
        self._model = model
        self._moves = [
            one for one, off in zip(moves, fit.residuals, strict=True) if off is not None
        ]
        self._known = known
        self._others = [name for name in shapes if name != ACCELERATION]
        self._at = len(fit.values) - len(shapes) + shapes.index(ACCELERATION)

    def profiles(self) -> tuple[Estimate, ...]:
        """Return all values, with intervals by what the walk has found."""
        error = self._fit.values[self._at].error
        begun = self._stop(self._model)
        if begun is None:
            return self._fit.values
        stops = [
            *reversed(self._side(begun, -error)),
            begun,
            *self._side(begun, error),
        ]
        best = min(stops, key=lambda one: one.squares)
        profiles: list[Estimate] = []
        for at, one in enumerate(self._fit.values):
            points = [self._point(stop, best, at) for stop in stops]
            if at == self._at and abs(points[0].off) < _FAR:  # all larger ones explain as much
                points.insert(0, points[0]._replace(value=0.0))
            profiles.append(Profile(one.value, one.error, one.spare, tuple(points)))
        return tuple(profiles)

    def _side(self, begun: _Stop, step: float) -> list[_Stop]:
        """Return where one comes to that goes on by about so much of the acceleration's inverse at a time."""
        stops = [begun]
        for _ in range(_STEPS):
            last = stops[-1]
            there = max(last.inverse + step, last.inverse / _FURTHEST)
            stop = self._stop(replace(last.model, acceleration=1 / there))
            if stop is None or not 1 / _ALIKE < there / begun.inverse < _ALIKE:
                break
            stops.append(stop)
            more = stop.squares - begun.squares
            if more > _FAR**2:
                break
            if abs(stop.squares - last.squares) < 1.0:
                step *= 1.5
        return stops[1:]

    def _stop(self, model: Motion) -> _Stop | None:
        """Return what is found for the acceleration of a model; None: that determines nothing."""
        stop: _Stop | None = None
        for _ in range(_ROUNDS):
            rows = [
                *measured(model, self._moves, self._known, shapes=self._others, pace=model.pace)
            ]
            solution = solve(rows, self._fit.weights)
            if solution is None:
                return None
            off = [
                (row.measured - one) ** 2 for row, one in zip(rows, solution.expected, strict=True)
            ]
            first = len(solution.values) - len(self._others)
            found = dict(zip(self._others, solution.values[first:], strict=True))
            changed = {name: one * getattr(model, name) for name, one in found.items()}
            model = replace(model, pace=solution.values[0])
            for name, factor in changed.items():
                slower = max(factor, 1 / _FURTHEST)
                model = with_value(model, name, getattr(model, name) / slower)
            stop = _Stop(model, solution, sum(map(mul, self._fit.weights, off)))
            if all(abs(factor - 1) < _SETTLED for factor in changed.values()):
                break
        return stop

    def _point(self, stop: _Stop, best: _Stop, at: int) -> Point:
        """Return what is found there of the value at a place among all."""
        away = stop.inverse - best.inverse
        off = copysign(sqrt(max(stop.squares - best.squares, 0.0)), away)
        if at == self._at:
            return Point(off, stop.inverse, 0.0)
        there = at - (at > self._at)
        return Point(off, stop.solution.values[there], sqrt(stop.solution.inverse[there][there]))
