"""How long do plans take with each policy, beside the best that is known?

`python benchmarks/allocation.py` draws 30 plans (`makespans/plans.py`) and flies each in virtual time, without faults
and without spread, with every policy and every `after_trip`, and with the defaults. With the extra `benchmarks`
a routing solver, PyVRP, plans them too, by the same model of motion (`makespans/routing.py` says what that leaves out), and its
routes are flown by a policy hook that follows them. The best known makespan of a plan is the least
of all that were flown. Printed are the ratios to it: median and worst of each column, then each plan.

The shift in which the solver can serve all is searched by halving; each try takes `--seconds`, so all of it takes
some ten minutes. Without PyVRP, or with `--seconds 0`, the best is that of the policies alone.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib.util import find_spec
from itertools import product
from math import inf
from pathlib import Path
from statistics import median

from makespans.flying import Apps
from makespans.plans import KINDS, OF_EACH_KIND, Plan, plans
from measuring.options import at_least_one

POLICIES = (
    *("first", "least_used", "nearest"),
    *("batch_optimal", "least_makespan", "earliest_deadline"),
)
AFTER = ("home", "stay", "next")
DEFAULTS, ROUTED = "defaults", "PyVRP"
BEFORE = "nearest, home"
"""The defaults until a table like this was measured."""
TRIES = 7
"""How often the solver's shift is halved."""
SHORTEST, LONGEST = 0.4, 1.5
"""The shares of the best policy's makespan between which shifts are tried."""

Row = Mapping[str, float]


def measured(apps: Apps, plan: Plan, seconds: float) -> Row:
    """Return the makespan of a plan in each column."""
    row = {
        f"{policy}, {after}": apps.flown(plan, policy, after)
        for policy, after in product(POLICIES, AFTER)
    }
    row[DEFAULTS] = apps.flown(plan, "", "")
    if seconds and find_spec("pyvrp") is not None:
        row[ROUTED] = routed(apps, plan, min(row.values()), seconds)
    return row


def routed(apps: Apps, plan: Plan, known: float, seconds: float) -> float:
    """Return the least makespan of a solver's routes that were flown; infinite: none could be."""
    from makespans.routing import Routing  # it needs the solver

    least, several = inf, False
    for whole in (True, False):
        routing = Routing(apps.loaded(plan, "nearest", "stay"), whole=whole)
        if not whole and not several:
            break
        several = routing.has_missions_of_several
        low, high = SHORTEST * known, LONGEST * known
        shift = high
        for _ in range(TRIES):
            routes = routing.routes(shift, seconds, seed=0)
            if routes is None:
                low = shift
            else:
                high = shift
                least = min(least, apps.followed(plan, routes))
            shift = (low + high) / 2
    return least


def table(rows: Mapping[str, Row], say: Callable[[str], None]) -> dict[str, object]:
    """Print the ratios to the best known makespans, and return all figures."""
    best = {name: min(row.values()) for name, row in rows.items()}
    ratios = {
        column: [row[column] / best[name] for name, row in rows.items()]
        for column in next(iter(rows.values()))
    }
    say(f"{'column':26}{'median':>8}{'worst':>8}")
    for column, found in ratios.items():
        say(f"{column:26}{shown(median(found)):>8}{shown(max(found)):>8}")
    usual = BEFORE, "nearest, next", "batch_optimal, next", DEFAULTS, ROUTED
    columns = [column for column in usual if column in ratios]
    say(f"\n{'plan':18}{'best, s':>8}" + "".join(f"{column:>21}" for column in columns))
    for place, (name, seconds) in enumerate(best.items()):
        cells = (f"{shown(ratios[column][place]):>21}" for column in columns)
        say(f"{name:18}{seconds:8.0f}" + "".join(cells))
    return {
        "ratios": {
            column: {"median": median(found), "worst": max(found)}
            for column, found in ratios.items()
        },
        "makespans_s": {name: dict(row) for name, row in rows.items()},
    }


def shown(ratio: float) -> str:
    """Return a ratio for people."""
    return "never" if ratio == inf else f"{ratio:.2f}"


def all_rows(chosen: Sequence[Plan], seconds: float) -> Iterator[tuple[str, Row]]:
    """Fly plans, one after the other."""
    with tempfile.TemporaryDirectory() as folder:
        apps = Apps(Path(folder))
        for plan in chosen:
            yield plan.name, measured(apps, plan, seconds)


def main() -> None:
    """Print the table, or JSON."""
    parser = argparse.ArgumentParser(description="Makespans by policy, beside the best known.")
    count = OF_EACH_KIND * len(KINDS)
    parser.add_argument("--plans", type=at_least_one, default=count, help="the first of the 30")
    parser.add_argument("--seconds", type=float, default=2.0, help="of the solver, each try")
    parser.add_argument("--json", action="store_true", help="print one object instead of a table")
    given = parser.parse_args()
    rows = dict(all_rows(list(plans(given.plans)), given.seconds))
    told = table(rows, (lambda line: None) if given.json else partial(print, flush=True))
    if given.json:
        print(json.dumps(told, indent=2))


if __name__ == "__main__":
    main()
