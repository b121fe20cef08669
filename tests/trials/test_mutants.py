"""What cases by chance find: every mistake that is planted in the runtime."""

from __future__ import annotations

import re

import pytest

from pluto_fleet.trials.explore import random_case
from pluto_fleet.trials.lives import tried
from tests.trials.examples import example, fleet_of
from tests.trials.mutants import MUTANTS

ENOUGH = 300
"""Cases within which each is found; but for a change of the runtime, its own is the first."""


@pytest.mark.parametrize("name", MUTANTS)
def test_every_mutant_is_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By what it does, and in time."""
    mutant = MUTANTS[name]
    app = example(mutant.example)
    fleet = fleet_of(mutant.example, app)
    mutant.plant(monkeypatch)
    said: dict[str, None] = {}
    for seed in range(mutant.seed, mutant.seed + ENOUGH):
        sentences = tried(app, random_case(app, fleet, seed)).violations
        said.update(dict.fromkeys(sentences[:1]))
        if any(re.search(mutant.says, sentence) for sentence in sentences):
            return
    pytest.fail(f"it was not found that {name}; what was said: {list(said)}")
