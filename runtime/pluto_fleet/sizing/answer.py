"""The answer: the smallest fleet that can be promised, or why there is none."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

from ..files.plan_check import unflyable
from .batteries import swapping
from .bounds import Rule
from .causes import Cause, Causes, reasons
from .fleets import Counts, Stock
from .search import Search
from .tries import Tally, Tries

if TYPE_CHECKING:
    from .question import Question
    from .tries import Watch

SWAP = 60.0
"""Seconds in which a practised person swaps the battery of a drone that is this small."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Answer:
    """What is told."""

    question: Question
    stock: Stock
    rule: Rule
    found: Tally | None
    """The smallest fleet that can be promised."""
    tallies: Sequence[Tally]
    """All that were flown, smaller ones first."""
    causes: Sequence[Cause] = ()
    """Why there is none; or, if there is one, why a drone less is too few."""
    with_swaps: Counts | None = None
    """The drones that would do if batteries were swapped; None: no fewer, or they are."""


def sized(
    question: Question, stock: Stock, rule: Rule, *, seed: int, jobs: int, watch: Watch
) -> Answer:
    """Fly candidate fleets until the smallest is found that can be promised."""

    @cache
    def able(counts: Counts) -> bool:
        fleet = stock.of(counts)
        assert fleet is not None
        return not unflyable(question.missions, question.app, fleet, fleet.airspace)

    tries = Tries(question, stock, rule, seed=seed, jobs=jobs, watch=watch)
    causes = Causes(tries)
    search = Search(tries, able, causes.late_alone)
    counts = search.smallest()
    tallies = sorted(tries.tallies.values(), key=lambda one: (one.drones, one.counts))
    if counts is None:
        why = causes.found() if tallies else _out_of_reach(question, stock)
        return Answer(
            question=question, stock=stock, rule=rule, found=None, tallies=tallies, causes=why
        )
    found = tries.tallies[counts]
    smaller = [one for one in tallies if one.drones < found.drones and one.failed]
    near = max(smaller, key=lambda one: (one.drones, one.succeeded), default=None)
    fewer = None
    if question.swapped is None:
        quick = replace(question, app=swapping(question.app, SWAP))
        others = Tries(quick, stock, rule, seed=seed, jobs=jobs, watch=watch)
        left = Search(others, able, lambda _: True).reduced(counts, range(len(counts)))
        fewer = left if sum(left) < found.drones else None
    return Answer(
        question=question,
        stock=stock,
        rule=rule,
        found=found,
        tallies=tallies,
        causes=list(reasons(question, near)) if near is not None else [],
        with_swaps=fewer,
    )


def _out_of_reach(question: Question, stock: Stock) -> list[Cause]:
    """Return which trips no fleet of the stock can do, whatever its size."""
    found = unflyable(question.missions, question.app, stock.fleet, stock.fleet.airspace)
    if not found:  # there is no room for as many as that takes
        return [Cause("drones", f"more than {stock.most} drones are needed: --max says how many")]
    return [Cause("reach", f"{one.called}: {one.reason}") for one in found]
