"""The optimised package and the plain one leave the same trace; `python -m tests.equivalence` does
the same with many more graphs."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

import pytest

from tests.equivalence.campaign import Tally, differs, first_finding, one_graph, sound
from tests.equivalence.coverage import missed
from tests.equivalence.graphs import random_source
from tests.equivalence.mutants import MUTANTS
from tests.equivalence.shrink import shrunk

GRAPHS = 60
ENOUGH = 150
"""Graphs within which every mutant must have shown itself; most do within ten."""


@pytest.fixture(scope="module")
def tally() -> Iterator[Tally]:
    """What comes of a small campaign."""
    tally = Tally()
    for number in range(GRAPHS):
        tally.add(one_graph(f"1/{number}"))
    yield tally


def test_optimised_and_plain_packages_leave_the_same_trace(tally: Tally) -> None:
    assert not tally.findings, str(shrunk(tally.findings[0], differs))


def test_a_campaign_meets_all_that_a_graph_can_hold_and_all_that_can_happen(tally: Tally) -> None:
    assert missed(tally.seen) == []


def test_most_of_the_random_sources_are_sound() -> None:
    drawn = [sound(random_source(Random(number))) for number in range(60)]
    assert sum(checked is not None for checked in drawn) > 40


@pytest.mark.parametrize("name", MUTANTS)
def test_a_mistake_in_a_pass_is_found(name: str) -> None:
    """Each would be a mistake of a pass, of what it emits, or of the wait that it emits."""
    finding = first_finding(MUTANTS[name], ENOUGH)
    assert finding is not None


def test_what_is_found_is_made_smaller() -> None:
    mutant = MUTANTS["a fused wait has no limits"]
    finding = first_finding(mutant, ENOUGH)
    assert finding is not None
    small = shrunk(finding, lambda text, world: differs(text, world, mutant))
    assert len(small.text) < len(finding.text)
    assert small.world is not None and finding.world is not None
    assert len(small.world.missions) <= len(finding.world.missions)
    assert differs(small.text, small.world, mutant) == small.said
    assert differs(small.text, small.world) is None
