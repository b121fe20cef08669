"""Sizes plans by chance, and holds each promise against fresh runs; finds planted answers.

    python -m tests.sizing --plans 100

A promise of 99 % holds if at least 99 % of 1,000 runs with other seeds succeed. Plans for which no fleet
can be promised are drawn again. Then as many plans without chance as `--exact` says are sized, and every
smaller fleet of each is flown. The exit code is 1 if fewer than 97 of 100 promises hold, a smaller fleet
does, or a planted answer is not found.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from time import perf_counter

from pluto_fleet.process.workers import cores
from tests.sizing.plans import (
    CONFIDENCE,
    FRESH,
    by_chance,
    fresh_share,
    known,
    sized_plan,
    smallest_by_trying_all,
    without_chance,
)

HOLD = 0.97
"""The least share of promises that must hold."""

ELSEWHERE = 1_000_000
"""The first of the fresh seeds."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the campaign."""
    parser = ArgumentParser(prog="python -m tests.sizing", description=__doc__)
    parser.add_argument("--plans", type=int, default=100, help="how many promises (default 100)")
    parser.add_argument(
        "--exact", type=int, default=30, help="how many without chance (default 30)"
    )
    parser.add_argument("--from", dest="first", type=int, default=0, help="the first plan's number")
    parser.add_argument("--jobs", type=int, default=cores())
    options = parser.parse_args(argv)
    held = promises(options.first, options.plans, options.jobs)
    right = exact(options.first, options.exact, options.jobs)
    found = sum(_planted(options.jobs))
    print(f"{held} of {options.plans} promises hold in {FRESH} fresh runs each")
    print(f"{right} of {options.exact} plans without chance are sized as flying every fleet says")
    print(f"{found} of {len(known())} planted answers are found")
    return int(held < HOLD * options.plans or right < options.exact or found < len(known()))


def promises(number: int, plans: int, jobs: int) -> int:
    """Return how many promises hold."""
    held = made = drawn = 0
    while made < plans:
        began = perf_counter()
        answer = sized_plan(by_chance(number), confidence=CONFIDENCE, jobs=jobs)
        number, drawn = number + 1, drawn + 1
        runs = sum(len(tally.runs) for tally in answer.tallies)
        took = perf_counter() - began
        if answer.found is None:
            why = answer.causes[0].what if answer.causes else "?"
            print(f"plan {number - 1}: none ({why}), {runs} runs, {took:.0f} s", flush=True)
            continue
        share = fresh_share(answer, runs=FRESH, seed=ELSEWHERE, jobs=jobs)
        made, held = made + 1, held + (share >= CONFIDENCE)
        found = answer.found
        print(
            f"plan {number - 1}: {found.counts} promised by {found.succeeded} of {len(found.runs)},"
            f" {100 * share:.1f} % of fresh runs; {runs} runs, {took:.0f} s; {held} of {made} hold",
            flush=True,
        )
    return held


def exact(number: int, plans: int, jobs: int) -> int:
    """Return for how many plans without chance the smallest fleet is found."""
    right = 0
    for place in range(number, number + plans):
        plan = without_chance(place)
        answer = sized_plan(plan, confidence=0.8, jobs=jobs)
        said = answer.found and answer.found.drones
        least = smallest_by_trying_all(plan)
        right += said == least
        if said != least:
            print(f"plan {place} without chance: {said} said, {least} would do", flush=True)
    return right


def _planted(jobs: int) -> list[bool]:
    found = []
    for case in known():
        answer = sized_plan(case.plan, confidence=CONFIDENCE, jobs=jobs)
        said = answer.found and answer.found.drones
        why = answer.causes[0] if answer.causes else None
        well = said == case.drones and (
            case.drones is not None
            or (why is not None and (why.what, case.said in why.text) == (case.cause, True))
        )
        found.append(well)
        if not well:
            print(f"{case.name}: {said} said, {why}", flush=True)
    return found


if __name__ == "__main__":
    sys.exit(main())
