"""What many runs of one plan have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import mean, median, quantiles

MOST_SEEDS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """What the summary needs to know of one run."""

    seed: int
    success: bool
    makespan: float
    attempts: int
    failed: int
    """Flights that failed."""


def summary(runs: Sequence[Run]) -> dict[str, object]:
    """Return the figures of all runs; there is at least one.

    The makespan is that of the runs that succeeded: a mission that failed early is not a fast one.
    """
    good = [run for run in runs if run.success]
    bad = [run.seed for run in runs if not run.success]
    return {
        "runs": len(runs),
        "succeeded": len(good),
        "success_rate": len(good) / len(runs),
        "makespan_s": spread([run.makespan for run in good]),
        "attempts": spread([float(run.attempts) for run in runs]),
        "failed_trips": spread([float(run.failed) for run in runs]),
        "failed_seeds": bad[:MOST_SEEDS],
    }


def spread(values: Sequence[float]) -> dict[str, float] | None:
    """Return how some numbers lie; None where there is none."""
    if not values:
        return None
    most = max(values)
    ninth = quantiles(values, n=10, method="inclusive")[-1] if len(values) > 1 else most
    return {
        "min": min(values),
        "median": median(values),
        "mean": mean(values),
        "p90": min(max(ninth, median(values)), most),  # rounding may lead it past its neighbours
        "max": most,
    }
