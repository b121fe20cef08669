"""What many runs of one plan have in common."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor
from statistics import mean, median
from typing import TYPE_CHECKING

from plutoc_runtime.alone.simulate import trips_data
from plutoc_runtime.domain.status import COMPLETED

from ..trials.invariants import ENDS, Invariants
from .verdict import exit_code

if TYPE_CHECKING:
    from plutoc_runtime.alone.simulate import Outcome

    from ..trials.invariants import Items

MOST_SEEDS = 20
ENOUGH = 20
"""Of fewer runs, the fifth and the ninety-fifth percentile are next to the least and the most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """What the summary needs to know of one run."""

    seed: int
    success: bool
    makespan: float
    attempts: int
    failed: int
    """Flights that failed."""
    completed: int = 0
    """Missions that were completed."""
    battery: float | None = None
    """The lowest level that any drone came down with; None: none flew."""
    violations: tuple[str, ...] = ()
    """What no run may do, whatever goes wrong, and this one did."""


def run_of(seed: int, outcome: Outcome, items: Items) -> Run:
    """Return what the summary needs to know of an outcome."""
    trips = trips_data(outcome)
    invariants = Invariants(items)
    levels: list[float] = []
    for event in outcome.events:
        invariants.take(event)
        level = event.get("battery")
        if isinstance(level, float):
            levels.append(level)
    whole = all(mission.status.value in ENDS for mission in outcome.missions)
    return Run(
        seed=seed,
        success=exit_code(outcome) == 0,
        makespan=outcome.duration,
        attempts=trips["attempts"],
        failed=trips["failed"],
        completed=sum(mission.status is COMPLETED for mission in outcome.missions),
        battery=min(levels, default=None),
        violations=tuple(invariants.over() if whole else invariants.found),
    )


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
        "completed_missions": spread([float(run.completed) for run in runs]),
        "makespan_s": spread([run.makespan for run in good]),
        "attempts": spread([float(run.attempts) for run in runs]),
        "failed_trips": spread([float(run.failed) for run in runs]),
        "battery_level": spread([run.battery for run in runs if run.battery is not None]),
        "failed_seeds": bad[:MOST_SEEDS],
        "violations": [
            {"seed": run.seed, "what": sentence} for run in runs for sentence in run.violations
        ],
    }


def spread(values: Sequence[float]) -> dict[str, float] | None:
    """Return how some numbers lie; None where there is none."""
    if not values:
        return None
    ordered = sorted(values)
    return {
        "min": ordered[0],
        "p5": percentile(ordered, 0.05),
        "median": median(ordered),
        "mean": mean(ordered),
        "p90": percentile(ordered, 0.90),
        "p95": percentile(ordered, 0.95),
        "max": ordered[-1],
    }


def percentile(ordered: Sequence[float], share: float) -> float:
    """Return the number below which this share of some numbers lies, between two neighbours."""
    place = share * (len(ordered) - 1)
    below, above = ordered[floor(place)], ordered[ceil(place)]
    return min(below + (above - below) * (place - floor(place)), above)
