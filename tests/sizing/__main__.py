"""Sizes plans by chance, and holds each promise against fresh runs; finds planted answers.

    python -m tests.sizing --plans 100

A promise of 99 % holds if at least 99 % of 1,000 runs with other seeds succeed. Plans for which no fleet
can be promised are drawn again. Then as many plans without chance as `--exact` says are sized, and every
smaller fleet of each is flown. The exit code is 1 if fewer than 97 of 100 promises hold, a smaller fleet
does, or a planted answer is not found.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import count

from pluto_fleet.process.workers import cores
from tests.kit.campaign import Campaign
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


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign."""
    campaign = Campaign("tests.sizing", __doc__)
    campaign.unit = "plan"
    campaign.option("--plans", type=int, default=100, help="how many promises (default: 100)")
    campaign.option("--exact", type=int, default=30, help="how many without chance (default: 30)")
    campaign.option("--from", dest="first", type=int, default=0, help="the first plan's number")
    campaign.option("--jobs", type=int, default=cores())
    options = campaign.parse(arguments)
    shares: list[float] = []

    def drawn() -> Iterator[int]:
        for number in count(options.first):
            if len(shares) == options.plans:
                return
            yield number

    for number, share in campaign.each(partial(promise, jobs=options.jobs), drawn()):
        if share is not None:
            shares.append(share)
            print(f"plan {number}: {100 * share:.1f} % of fresh runs succeed", flush=True)
    exact = range(options.first, options.first + options.exact)
    for number, wrong in campaign.each(partial(smallest, jobs=options.jobs), exact):
        if wrong:
            campaign.found(f"plan {number} without chance", wrong)
    for name, wrong in campaign.each(
        partial(planted, jobs=options.jobs), [c.name for c in known()]
    ):
        if wrong:
            campaign.found(name, wrong)
    held = sum(share >= CONFIDENCE for share in shares)
    if held < HOLD * options.plans:
        campaign.found("too few promises hold")
    return campaign.over(f"{held} of {options.plans} promises hold in {FRESH} fresh runs each")


def promise(number: int, jobs: int) -> float | None:
    """Return the share of fresh runs that succeed with the promised fleet; None: there is none."""
    answer = sized_plan(by_chance(number), confidence=CONFIDENCE, jobs=jobs)
    if answer.found is None:
        return None
    return fresh_share(answer, runs=FRESH, seed=ELSEWHERE, jobs=jobs)


def smallest(number: int, jobs: int) -> str:
    """Say whether another fleet than the one found is the smallest of a plan without chance."""
    plan = without_chance(number)
    answer = sized_plan(plan, confidence=0.8, jobs=jobs)
    said, least = answer.found and answer.found.drones, smallest_by_trying_all(plan)
    return "" if said == least else f"{said} said, {least} would do"


def planted(name: str, jobs: int) -> str:
    """Say how the answer to a known plan differs from what is known of it."""
    (case,) = (one for one in known() if one.name == name)
    return case.wrong(sized_plan(case.plan, confidence=CONFIDENCE, jobs=jobs))


if __name__ == "__main__":
    sys.exit(main())
