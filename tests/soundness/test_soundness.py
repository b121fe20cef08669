"""The compiler's checks against the oracle; `python -m tests.soundness` compares all of it."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest

from tests.soundness.app import App, thesis_graphs
from tests.soundness.compare import compare, refused
from tests.soundness.mutants import EDITS, Mutant, mutants
from tests.soundness.oracle import judge
from tests.soundness.randoms import event_app, looping_app, random_app
from tests.soundness.state import Verdict
from tests.soundness.table import SOUND, UNSOUND, Tally

GRAPHS = thesis_graphs()
SHARE = 40
"""One mutant of so many is looked at here."""


def share(name: str) -> list[Mutant]:
    """Return a share of a graph's mutants, of each edit some, and the same ones every time."""
    found = list(mutants(GRAPHS[name]))
    rng = Random(name)
    chosen: list[Mutant] = []
    for edit in EDITS:
        of_edit = [mutant for mutant in found if mutant.edit == edit]
        chosen.extend(rng.sample(of_edit, -(-len(of_edit) // SHARE)))
    return chosen


@pytest.mark.parametrize("name", GRAPHS)
def test_graph_of_the_thesis_can_be_flown(name: str) -> None:
    assert judge(GRAPHS[name]).sound
    assert refused(GRAPHS[name].text) == ()


@pytest.mark.parametrize("name", GRAPHS)
def test_compiler_and_oracle_agree_on_what_is_one_edit_away(name: str) -> None:
    for mutant in share(name):
        compared = compare(mutant.app)
        assert compared.agrees, (mutant.edit, mutant.what, compared)


@pytest.mark.parametrize("draw", [random_app, event_app])
def test_compiler_and_oracle_agree_on_random_apps(draw: Callable[[Random], App]) -> None:
    tally = Tally()
    for seed in range(60):
        app = draw(Random(seed))
        compared = compare(app)
        tally.add(compared)
        assert compared.agrees, (seed, app.text, compared)
    assert tally.counts[SOUND] > 5
    assert tally.counts[UNSOUND] > 20


def test_compiler_and_oracle_agree_on_loops_on_which_nothing_is_flown() -> None:
    tally = Tally()
    for seed in range(60):
        app = looping_app(Random(f"loops/{seed}"))
        compared = compare(app)
        tally.add(compared)
        assert compared.agrees, (seed, app.text, compared)
    assert tally.counts[SOUND] > 15
    assert tally.counts[Verdict.ENDLESS] > 10
    assert tally.codes["P2025"] > 2
