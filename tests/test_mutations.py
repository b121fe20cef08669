"""One mistake is told once: a share of what `python -m tests.mutations` does."""

from __future__ import annotations

from tests.compiler.emit.apps import TYPED
from tests.mutations import ENOUGH, mutants, outcome, share


def test_one_mistake_gives_one_diagnostic() -> None:
    """Of nearly all files broken by one random edit. None raises, each has a tree."""
    outcomes = [outcome(mutant) for mutant in mutants(200, seed=11)]
    assert sum(each.broken for each in outcomes) > 100
    several = [[d.code for d in each.found] for each in outcomes if len(each.found) > 1]
    assert share(outcomes) >= ENOUGH, several


def test_one_mistake_in_fields_results_and_parameters_gives_one_diagnostic() -> None:
    """In an app that has them all, most of whose text they are."""
    outcomes = [outcome(mutant) for mutant in mutants(150, seed=12, text=TYPED)]
    assert sum(each.broken for each in outcomes) > 75
    several = [[d.code for d in each.found] for each in outcomes if len(each.found) > 1]
    assert share(outcomes) >= ENOUGH, several
