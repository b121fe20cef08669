"""Weighted least squares with honest standard errors, for a handful of parameters, and what is found by them.

Plain Python: a journal has thousands of commands at most, and four parameters explain them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import exp, inf, log, sqrt
from operator import mul
from statistics import NormalDist, median
from typing import NamedTuple

from ..shared.domain.motion import Motion
from ..shared.domain.text import counted

OUTLIER = 5.0
"""Standard deviations from which on a measurement is left out; what varies normally has none there."""
JUDGED_FROM = 10
"""Measurements more than parameters, from which on outliers can be told from the rest."""
_NORMAL = NormalDist()
_SAME = 1.4826
"""The standard deviation of a normal distribution, over its median absolute deviation."""

_CLOSE = 1e-3
"""The residual up to which a measurement counts no more than another: a few must not outweigh all the rest."""
_LEAST = 1e-3
"""What is expected at least of a measurement that varies in proportion to itself."""
_ROBUST = 20
"""Rounds in which the least sum of absolute residuals is found."""
_EVEN = 6
"""Rounds in which it is found by how much each kind of measurements varies."""
_BETWEEN = 8
"""Parts into which the way from one point of a profile to the next is cut."""
SPARE = 5
"""How many measurements there must be more than parameters."""

Matrix = list[list[float]]


class Row(NamedTuple):
    """One measurement: the sum of all parameters, each times its factor, and what was measured."""

    factors: tuple[float, ...]
    measured: float
    given: float = 0.0
    """What is added to that sum."""
    kind: str = ""
    """Measurements of a kind vary alike."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A value found from measurements."""

    value: float
    error: float
    """Its standard error."""
    spare: float
    """How many measurements there were more than parameters; of several kinds, as many as tell as much."""

    def interval(self, level: float) -> tuple[float, float]:
        """Return the interval that holds the true value with this probability."""
        reach = student((1 + level) / 2, self.spare) * self.error
        return self.value - reach, self.value + reach


@dataclass(frozen=True, slots=True)
class Spread(Estimate):
    """A standard deviation found from measurements."""

    def interval(self, level: float) -> tuple[float, float]:
        """Return the interval that holds the true value with this probability."""
        low, high = ((1 - level) / 2, (1 + level) / 2)
        sum_of_squares = self.value**2 * self.spare
        return (
            sqrt(sum_of_squares / chi_square(high, self.spare)),
            sqrt(sum_of_squares / chi_square(low, self.spare)),
        )


@dataclass(frozen=True, slots=True)
class Profile(Estimate):
    """A value found together with one on which measurements do not depend in proportion."""

    points: tuple[Point, ...]
    """By ascending values of that other one."""

    def interval(self, level: float) -> tuple[float, float]:
        """Return the interval that holds the true value with this probability."""
        reach = student((1 + level) / 2, self.spare)
        low, high = inf, -inf
        for point in _filled(self.points):
            if abs(point.off) <= reach:
                rest = sqrt(reach**2 - point.off**2) * point.error
                low = min(low, point.value - rest)
                high = max(high, point.value + rest)
        return low, high


class Point(NamedTuple):
    """What is found if another value is taken as given."""

    off: float
    """How many standard errors that other value is off: the root of what it adds to the sum of squares."""
    value: float
    error: float
    """The value's, if the other were known."""


def _filled(points: Sequence[Point]) -> Iterator[Point]:
    """Yield the points, and some between them: all change nearly evenly from one to the next."""
    for one, other in pairwise(points):
        for at in range(_BETWEEN):
            part = at / _BETWEEN
            yield Point(*[a + part * (b - a) for a, b in zip(one, other, strict=True)])
    yield points[-1]


@dataclass(frozen=True, slots=True)
class Rate(Estimate):
    """A value of which the inverse was found from measurements: a speed, from seconds for each metre."""

    inverse: Estimate

    @classmethod
    def of(cls, inverse: Estimate) -> Rate:
        """Return the value."""
        return cls(1 / inverse.value, inverse.error / inverse.value**2, inverse.spare, inverse)

    def interval(self, level: float) -> tuple[float, float]:
        """Return the interval that holds the true value with this probability."""
        low, high = self.inverse.interval(level)
        return 1 / high, 1 / low if low > 0 else inf


@dataclass(frozen=True, slots=True)
class Fit:
    """The parameters that explain measurements best."""

    values: tuple[Estimate, ...]
    spreads: Mapping[str, Spread]
    """The standard deviation of a measurement, by its kind: as a share of it, if the fit is relative."""
    residuals: tuple[float | None, ...]
    """By how much each measurement is off, in the same unit; None: it was left out."""
    weights: tuple[float, ...]
    """Of those that were not left out, the inverse of each one's variance."""

    @property
    def left_out(self) -> int:
        """How many measurements are so far off that they do not count."""
        return sum(one is None for one in self.residuals)

    @property
    def spare(self) -> int:
        """How many measurements there were more than parameters."""
        return len(self.weights) - len(self.values)

    @property
    def scatter(self) -> float:
        """How badly it explains what was measured: what it leaves out counts, too."""
        spare = sum(one.spare for one in self.spreads.values())
        typical = sum(one.spare * log(one.value) for one in self.spreads.values()) / spare
        return exp(typical) * (1 + self.left_out / (self.spare + self.left_out))


def fitted(rows: Sequence[Row], *, relative: bool, finest: float, near: float) -> Fit | None:
    """Fit the parameters to measurements; None: these do not determine them.

    `relative`: each measurement varies in proportion to itself; otherwise all of a kind vary alike.
    `finest`: the standard deviation that comes from rounding alone. `near`: what is not further off
    than that is never left out.
    """
    count = len(rows[0].factors) if rows else 0
    if len(rows) <= count or not count:
        return None
    off = _robustly(rows, relative, max(finest, _CLOSE))
    if off is None:
        return None
    kept = [True] * len(rows)
    if len(rows) - count >= JUDGED_FROM:
        typical = max(_SAME * median(sorted(map(abs, off))[count:]), finest)
        furthest = {
            kind: max(OUTLIER * max(typical, _SAME * median(map(abs, those))), near)
            for kind, those in _by_kind(rows, off).items()
        }
        kept = [abs(one) <= furthest[row.kind] for row, one in zip(rows, off, strict=True)]
    good = [row for row, keep in zip(rows, kept, strict=True) if keep]
    return _evenly(good, kept, relative, finest) if len(good) > count else None


def _by_kind(rows: Sequence[Row], what: Sequence[float]) -> dict[str, list[float]]:
    kinds: dict[str, list[float]] = {}
    for row, one in zip(rows, what, strict=True):
        kinds.setdefault(row.kind, []).append(one)
    return kinds


def _robustly(rows: Sequence[Row], relative: bool, close: float) -> list[float] | None:
    """Return the residuals of the least sum of absolute residuals, as outliers move that little."""
    off = [1.0] * len(rows)
    scale = _scale(relative, [row.measured for row in rows])
    for _ in range(_ROBUST):
        weights = [1 / (max(abs(o), close) * s * s) for o, s in zip(off, scale, strict=True)]
        solved = solve(rows, weights)
        if solved is None:
            return None
        scale = _scale(relative, solved.expected)
        off = _off(rows, solved.expected, scale)
    return off


def _evenly(rows: Sequence[Row], kept: Sequence[bool], relative: bool, finest: float) -> Fit | None:
    """Find the least sum of squares, and by how much each kind of measurements varies."""
    scale = _scale(relative, [row.measured for row in rows])
    spreads = {row.kind: Spread(1.0, 0.0, 1.0) for row in rows}
    estimates: tuple[Estimate, ...] | None = None
    whole = len(rows) - len(rows[0].factors)
    for _ in range(_EVEN):
        weights = [
            1 / (spreads[row.kind].value * one) ** 2 for row, one in zip(rows, scale, strict=True)
        ]
        solved = solve(rows, weights)
        if solved is None:
            return None
        scale = _scale(relative, solved.expected)
        off = _off(rows, solved.expected, scale)
        pooled = sqrt(sum(one**2 for one in off) / whole)
        parts = {kind: _part(rows, weights, kind) for kind in spreads}
        for kind, those in _by_kind(rows, off).items():
            spare = len(those) - _trace(solved.inverse, parts[kind])
            value = pooled
            if spare < SPARE:  # these few do not tell it
                spare = whole
            else:
                value = sqrt(sum(one**2 for one in those) / spare)
            value = max(value, finest)
            spreads[kind] = Spread(value, value / sqrt(2 * spare), spare)
        estimates = _estimates(solved, parts, spreads)
    if estimates is None:
        return None
    remaining = iter(off)
    residuals = tuple(next(remaining) if keep else None for keep in kept)
    return Fit(estimates, spreads, residuals, tuple(weights))


def _estimates(
    solved: Solution, parts: Mapping[str, Matrix], spreads: Mapping[str, Spread]
) -> tuple[Estimate, ...] | None:
    """Return the parameters with their errors; None: numbers are too far apart to tell these."""
    estimates: list[Estimate] = []
    for value, line in zip(solved.values, solved.inverse, strict=True):
        # Welch and Satterthwaite: what each kind adds to the variance
        adds = {kind: _twice(line, part) for kind, part in parts.items()}
        variance = sum(adds.values())
        if variance <= 0:
            return None
        spare = variance**2 / sum(adds[kind] ** 2 / spreads[kind].spare for kind in adds)
        estimates.append(Estimate(value, sqrt(variance), spare))
    return tuple(estimates)


def _scale(relative: bool, expected: Sequence[float]) -> list[float]:
    return [max(abs(one), _LEAST) if relative else 1.0 for one in expected]


def _off(rows: Sequence[Row], expected: Sequence[float], scale: Sequence[float]) -> list[float]:
    return [(row.measured - e) / s for row, e, s in zip(rows, expected, scale, strict=True)]


def _part(rows: Sequence[Row], weights: Sequence[float], kind: str) -> Matrix:
    """Return what one kind adds to the matrix of the normal equations."""
    those = [(row, one) for row, one in zip(rows, weights, strict=True) if row.kind == kind]
    matrix, _ = _normal_equations([row for row, _ in those], [one for _, one in those])
    return matrix


def _trace(matrix: Matrix, other: Matrix) -> float:
    """Return the trace of the product of two symmetric matrices."""
    return float(sum(sum(map(mul, a, b)) for a, b in zip(matrix, other, strict=True)))


def _twice(line: Sequence[float], matrix: Matrix) -> float:
    """Return the product of a line, a matrix, and the line again."""
    return float(sum(one * sum(map(mul, line, row)) for one, row in zip(line, matrix, strict=True)))


class Solution(NamedTuple):
    """What solves normal equations."""

    values: list[float]
    inverse: Matrix
    """Of the equations' matrix."""
    expected: list[float]
    """What it makes of each measurement."""


def solve(rows: Sequence[Row], weights: Sequence[float]) -> Solution | None:
    """Return the parameters with the least weighted sum of squares; None: nothing determines them."""
    matrix, right = _normal_equations(rows, weights)
    inverse = _inverse(matrix)
    if inverse is None or any(line[at] <= 0 for at, line in enumerate(inverse)):
        return None
    values = [sum(map(mul, line, right)) for line in inverse]
    expected = [row.given + sum(map(mul, row.factors, values)) for row in rows]
    return Solution(values, inverse, expected)


def _normal_equations(rows: Sequence[Row], weights: Sequence[float]) -> tuple[Matrix, list[float]]:
    columns = [list(column) for column in zip(*[row.factors for row in rows], strict=True)]
    weighted = [[*map(mul, column, weights)] for column in columns]
    measured = [row.measured - row.given for row in rows]
    right = [sum(map(mul, column, measured)) for column in weighted]
    return [[sum(map(mul, one, other)) for other in columns] for one in weighted], right


def _inverse(matrix: Matrix) -> Matrix | None:
    """Invert a symmetric matrix; None: it is singular, or nearly so."""
    count = len(matrix)
    sizes = [sqrt(matrix[i][i]) if matrix[i][i] > 0 else 0.0 for i in range(count)]
    if not all(sizes):
        return None
    rows = [  # scaled to ones on the diagonal, and beside it the unit matrix
        [matrix[i][j] / (sizes[i] * sizes[j]) for j in range(count)]
        + [float(i == j) for j in range(count)]
        for i in range(count)
    ]
    for at in range(count):
        best = max(range(at, count), key=lambda row: abs(rows[row][at]))
        rows[at], rows[best] = rows[best], rows[at]
        if abs(rows[at][at]) < 1e-9:
            return None
        rows[at] = [one / rows[at][at] for one in rows[at]]
        for other in range(count):
            if other != at:
                factor = rows[other][at]
                rows[other] = [a - factor * b for a, b in zip(rows[other], rows[at], strict=True)]
    return [
        [rows[i][count + j] / (sizes[i] * sizes[j]) for j in range(count)] for i in range(count)
    ]


# Quantiles


def student(probability: float, spare: float) -> float:
    """Return a quantile of Student's t distribution (Abramowitz and Stegun 26.7.5)."""
    z, n = _NORMAL.inv_cdf(probability), spare
    return float(
        z
        + (z**3 + z) / (4 * n)
        + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2)
        + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * n**3)
        + (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / (92160 * n**4)
    )


def chi_square(probability: float, spare: float) -> float:
    """Return a quantile of the chi-square distribution (Wilson and Hilferty 1931)."""
    part = 2 / (9 * spare)
    return float(spare * max(1 - part + _NORMAL.inv_cdf(probability) * sqrt(part), 0.0) ** 3)


SURE = 0.95
"""The probability with which all intervals hold, all of them at once."""
WIDEST = {"pace": 0.2, "drain": 0.5, "charge": 0.5, "shape": 0.5}
"""Half an interval, as a share of its value, from which on that says nothing."""


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


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionTime:
    """An action of an app's own, and how long it took on average, in seconds."""

    app: str
    name: str
    seconds: float
    interval: tuple[float, float]
    count: int
    """In how many trips it was done."""
    planned: float
    """What plans count with, on average of the same trips."""
    parameter: str | None
    """The parameter of a trip that says so; None: it is the same in all."""


@dataclass(slots=True, kw_only=True)
class Calibration:
    """What journals tell of a fleet."""

    model: Motion
    """How it is said to move."""
    found: dict[str, Found] = field(default_factory=dict)
    """By the keys of `[motion]`, and `charge`: the share of `charge_time` that a charge takes."""
    untold: dict[str, str] = field(default_factory=dict)
    """What could not be told, and why."""
    own: list[ActionTime] = field(default_factory=list)
    """The apps' own actions that were done often enough."""
    notes: list[str] = field(default_factory=list)
    """What does not fit into `[motion]`."""
    commands: int = 0
    broken_off: int = 0
    failed: int = 0
    far_off: int = 0

    def bound(self) -> None:
        """Give each value its interval, so that all hold at once; drop those that say nothing."""
        while self.found:
            level = sure_of_each(len(self.found) + len(self.untold))
            for name, found in self.found.items():
                low, high = found.estimate.interval(level)
                self.found[name] = replace(found, low=max(low, 0.0), high=max(high, 0.0))
            vague = {
                name: found
                for name, found in self.found.items()
                if (found.high - found.low) / 2 > WIDEST.get(name, inf) * found.value
            }
            if not vague:
                return
            for name, found in vague.items():
                del self.found[name]
                self.untold[name] = f"{counted(found.count, found.of)} leave it open"


def sure_of_each(values: int) -> float:
    """Return with which probability each of so many values must be in its interval, so that all are at once."""
    return 1 - (1 - SURE) / values


def too_few(count: int, of: str, least: int) -> str:
    """Return why a value could not be told: there is too little of something."""
    return f"it takes {least} {of}s at least, and there {'is' if count == 1 else 'are'} {count}"
