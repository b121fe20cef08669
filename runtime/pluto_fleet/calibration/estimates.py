"""Weighted least squares with honest standard errors, for a handful of parameters, and what is found by them.

Plain Python: a journal has thousands of commands at most, and four parameters explain them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import inf, sqrt
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

Matrix = list[list[float]]


class Row(NamedTuple):
    """One measurement: the sum of all parameters, each times its factor, and what was measured."""

    factors: tuple[float, ...]
    measured: float
    given: float = 0.0
    """What is added to that sum."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """A value found from measurements."""

    value: float
    error: float
    """Its standard error."""
    spare: int
    """How many measurements there were more than parameters."""

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
class Rate(Estimate):
    """A value of which the inverse was found from measurements: a speed, from seconds for each metre."""

    @classmethod
    def of(cls, inverse: Estimate) -> Rate:
        """Return the value."""
        return cls(1 / inverse.value, inverse.error / inverse.value**2, inverse.spare)

    def interval(self, level: float) -> tuple[float, float]:
        """Return the interval that holds the true value with this probability."""
        inverse = Estimate(1 / self.value, self.error / self.value**2, self.spare)
        low, high = inverse.interval(level)
        return 1 / high, 1 / low if low > 0 else inf


@dataclass(frozen=True, slots=True)
class Fit:
    """The parameters that explain measurements best."""

    values: tuple[Estimate, ...]
    spread: Spread
    """The standard deviation of a measurement: as a share of it, if the fit is relative."""
    residuals: tuple[float | None, ...]
    """By how much each measurement is off, in the same unit; None: it was left out."""

    @property
    def left_out(self) -> int:
        """How many measurements are so far off that they do not count."""
        return sum(one is None for one in self.residuals)


def fitted(rows: Sequence[Row], *, relative: bool, finest: float, near: float) -> Fit | None:
    """Fit the parameters to measurements; None: these do not determine them.

    `relative`: each measurement varies in proportion to itself; otherwise all vary alike.
    `finest`: the standard deviation that comes from rounding alone. `near`: what is not further off
    than that is never left out.
    """
    count = len(rows[0].factors) if rows else 0
    if len(rows) <= count or not count:
        return None
    # the least sum of absolute residuals, as outliers move that little
    close = max(finest, _CLOSE)
    robust = _solved(rows, relative, lambda off: 1 / max(abs(off), close), rounds=40)
    if robust is None:
        return None
    off = robust[2]
    typical = max(_SAME * median(sorted(map(abs, off))[count:]), finest)
    judged = len(rows) - count >= JUDGED_FROM
    furthest = max(OUTLIER * typical, near)
    kept = [not judged or abs(one) <= furthest for one in off]
    good = [row for row, keep in zip(rows, kept, strict=True) if keep]
    solved = _solved(good, relative, lambda _: 1.0, rounds=10)
    spare = len(good) - count
    if solved is None or spare < 1:
        return None
    values, inverse, off = solved
    deviation = max(sqrt(sum(one**2 for one in off) / spare), finest)
    estimates = tuple(
        Estimate(value, deviation * sqrt(inverse[at][at]), spare) for at, value in enumerate(values)
    )
    remaining = iter(off)
    residuals = tuple(next(remaining) if keep else None for keep in kept)
    return Fit(estimates, Spread(deviation, deviation / sqrt(2 * spare), spare), residuals)


def _solved(
    rows: Sequence[Row], relative: bool, weigh: Callable[[float], float], *, rounds: int
) -> tuple[list[float], Matrix, list[float]] | None:
    """Return the parameters, the inverse of the normal equations' matrix, and the residuals.

    In each round a measurement's weight follows from its residual of the last one, and, if it varies
    in proportion to itself, from what was expected of it.
    """
    off, scale = [0.0] * len(rows), [abs(row.measured) if relative else 1.0 for row in rows]
    weights, values = [1.0] * len(rows), list[float]()
    inverse: Matrix | None = None
    for _ in range(rounds):
        matrix, right = _normal_equations(
            rows,
            [weight / max(one, _LEAST) ** 2 for weight, one in zip(weights, scale, strict=True)],
        )
        inverse = _inverse(matrix)
        if inverse is None:
            return None
        values = [sum(map(mul, line, right)) for line in inverse]
        expected = [row.given + sum(map(mul, row.factors, values)) for row in rows]
        if relative:
            scale = [max(abs(one), _LEAST) for one in expected]
        off = [(row.measured - e) / s for row, e, s in zip(rows, expected, scale, strict=True)]
        weights = [weigh(one) for one in off]
    return None if inverse is None else (values, inverse, off)


def _normal_equations(rows: Sequence[Row], weights: Sequence[float]) -> tuple[Matrix, list[float]]:
    count = len(rows[0].factors)
    matrix, right = [[0.0] * count for _ in range(count)], [0.0] * count
    for row, weight in zip(rows, weights, strict=True):
        for i, factor in enumerate(row.factors):
            right[i] += weight * factor * (row.measured - row.given)
            for j, other in enumerate(row.factors):
                matrix[i][j] += weight * factor * other
    return matrix, right


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


def student(probability: float, spare: int) -> float:
    """Return a quantile of Student's t distribution (Abramowitz and Stegun 26.7.5)."""
    z, n = _NORMAL.inv_cdf(probability), spare
    return float(
        z
        + (z**3 + z) / (4 * n)
        + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2)
        + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * n**3)
        + (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / (92160 * n**4)
    )


def chi_square(probability: float, spare: int) -> float:
    """Return a quantile of the chi-square distribution (Wilson and Hilferty 1931)."""
    part = 2 / (9 * spare)
    return float(spare * max(1 - part + _NORMAL.inv_cdf(probability) * sqrt(part), 0.0) ** 3)


SURE = 0.95
"""The probability with which all intervals hold, all of them at once."""
SPARE = 5
"""How many measurements there must be more than parameters."""
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
            level = 1 - (1 - SURE) / len(self.found)
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


def too_few(count: int, of: str, least: int) -> str:
    """Return why a value could not be told: there is too little of something."""
    return f"it takes {least} {of}s at least, and there {'is' if count == 1 else 'are'} {count}"
