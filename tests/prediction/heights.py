"""Compares what is promised of plans with flights in virtual time, whose heights are some centimetres others.

    python -m tests.prediction.heights
    python -m tests.prediction.heights --seeds 20 --by 0.1 drugs_distribution_retry
    python -m tests.prediction.heights --seeds 5 --by 0 aerial_mapping pm10

For each seed the cruise height of the fleet file is drawn anew, and the drones sway and drift otherwise. No
height may make a plan longer by more than is promised of that very plan.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from random import Random
from statistics import median, quantiles
from tempfile import mkdtemp

from pluto_fleet.app import App
from pluto_fleet.files.fleet import load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from tests.kit.apps import NAMES, imported
from tests.kit.campaign import Campaign
from tests.prediction.jumping import flown
from tests.prediction.plans import known
from tests.prediction.table import ERROR

_RUNS = 20
"""Simulations of each plan."""
Case = tuple[str, int, float]
"""A plan, a seed, and by how many metres its height differs at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Seen:
    """What was promised, and what came; seconds."""

    low: float
    middle: float
    high: float
    flown: float
    failed: int

    @property
    def inside(self) -> bool:
        """Whether that was between the 5th and the 95th percentile of what was promised."""
        return self.low <= self.flown <= self.high


@cache
def _ready(name: str) -> tuple[App, Path]:
    plan = known()[name]
    folder = Path(mkdtemp(prefix="heights-"))
    plan.write(folder / "plan")
    return imported(plan.app, plan.compiled(folder / "app").parent), folder / "plan"


def seen(case: Case) -> Seen:
    """Simulate a plan and fly it once."""
    name, seed, by = case
    app, folder = _ready(name)
    fleet = load_fleet(folder / "fleet.toml", app)
    height = fleet.airspace.cruise_height + Random(seed).uniform(-by, by)
    fleet = replace(fleet, airspace=replace(fleet.airspace, cruise_height=height))

    def simulated(run: int) -> float:
        missions = load_missions(folder / "missions.toml", app, fleet.airspace)
        plain = Faults()
        came = simulate(app, missions, fleet, seed=run, faults=plain, until=None, on_event=None)
        return came.duration

    spans = [simulated(run) for run in range(_RUNS)]
    cuts = quantiles(spans, n=20, method="inclusive")
    missions = load_missions(folder / "missions.toml", app, fleet.airspace)
    flight = flown(app, missions, fleet, seed=seed)
    return Seen(
        low=cuts[0],
        middle=median(spans),
        high=cuts[-1],
        flown=flight.makespan,
        failed=flight.failed + flight.code,
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the plans that are named; 1 if one fails, or the median is not what is promised."""
    campaign = Campaign("tests.prediction.heights", __doc__)
    campaign.option("names", nargs="*", metavar="PLAN", help="default: the nine examples")
    campaign.option("--seeds", type=int, default=5, metavar="N", help="flights of each (5)")
    campaign.option("--by", type=float, default=0.1, metavar="METRES", help="how far (0.1)")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    names = options.names or list(NAMES)
    cases = [(name, seed, options.by) for name in names for seed in range(options.seeds)]
    came: dict[str, list[Seen]] = {}
    for (name, seed, _), one in campaign.each(seen, cases):
        came.setdefault(name, []).append(one)
        if one.failed:
            campaign.found(f"{name}, seed {seed}", "a trip has failed")
    lines = []
    for name, flights in came.items():
        spans = [one.flown for one in flights]
        off = 100.0 * median((one.middle - one.flown) / one.flown for one in flights)
        inside = sum(one.inside for one in flights)
        lines.append(
            f"{name}: {min(spans):.1f}–{max(spans):.1f} s flown, promised {off:+.1f} %,"
            f" {inside} of {len(flights)} within 5–95 %"
        )
        if abs(off) > ERROR:
            campaign.found(name, lines[-1])
    return campaign.over(*lines)


if __name__ == "__main__":
    sys.exit(main())
