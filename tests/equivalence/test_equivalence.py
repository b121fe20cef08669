"""The optimised package and the plain one leave the same trace; `python -m tests.equivalence` does
the same with many more graphs, and looks whether all occurs in them that can."""

from __future__ import annotations

from random import Random

import pytest

from tests.equivalence.campaign import differs, first_finding, one_graph, smallest, sound
from tests.equivalence.mutants import MUTANTS
from tests.kit.graphs.graph import random_source

GRAPHS = 8
ENOUGH = 150
"""Graphs within which every mutant must have shown itself."""


@pytest.mark.parametrize("number", range(GRAPHS))
def test_optimised_and_plain_packages_leave_the_same_trace(number: int) -> None:
    found = one_graph(f"1/{number}")
    assert not found.findings, str(found.findings[0])
    assert found.events > 0


def test_most_of_the_random_sources_are_sound() -> None:
    drawn = [sound(random_source(Random(number))) for number in range(30)]
    assert sum(checked is not None for checked in drawn) > 20


@pytest.mark.parametrize("name", MUTANTS)
def test_a_mistake_in_a_pass_is_found(name: str) -> None:
    """Each would be a mistake of a pass, of what it emits, or of the wait that it emits."""
    first, mutant = MUTANTS[name]
    assert first_finding(mutant, first, ENOUGH) is not None


def test_what_is_found_is_made_smaller() -> None:
    first, mutant = MUTANTS["a fused wait has no limits"]
    finding = first_finding(mutant, first, ENOUGH)
    assert finding is not None and finding.world is not None
    small = smallest(finding, mutant, tries=60)
    assert len(small.text) < len(finding.text)
    assert small.world is not None
    assert len(small.world.missions) <= len(finding.world.missions)
    assert differs(small.text, small.world, mutant) == small.said
    assert differs(small.text, small.world) is None
