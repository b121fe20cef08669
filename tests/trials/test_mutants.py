"""What a small case and some by chance find: every mistake that is planted in the runtime."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import chain

import pytest

from pluto_fleet.trials.case import strikes_of
from pluto_fleet.trials.explore import everywhere, random_case, small_case
from pluto_fleet.trials.lives import tried
from tests.trials.examples import example, fleet_of
from tests.trials.mutants import MUTANTS

BY_CHANCE = 30
"""Cases that are tried first: but for a change of the runtime, the mutant's own is the first of them."""


@pytest.mark.parametrize("name", MUTANTS)
def test_every_mutant_is_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By what it does, and in time."""
    mutant = MUTANTS[name]
    app = example(mutant.example)
    fleet = fleet_of(mutant.example, app)
    mutant.plant(monkeypatch)
    said: dict[str, None] = {}
    small = small_case(app, fleet, 0)
    struck = [replace(small, strikes=strikes_of(mutant.strikes))] if mutant.strikes else []
    by_chance = (random_case(app, fleet, mutant.seed + number) for number in range(BY_CHANCE))
    for case in chain(struck, by_chance, everywhere(app, small)):
        sentences = tried(app, case).violations
        said.update(dict.fromkeys(sentences[:1]))
        if any(re.search(mutant.says, sentence) for sentence in sentences):
            return
    pytest.fail(f"it was not found that {name}; what was said: {list(said)}")
