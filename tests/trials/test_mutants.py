"""The suite finds every mistake that is planted in the runtime, within what CI has time for."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.trials.case import FAIR, Case
from pluto_fleet.trials.explore import everywhere, random_case, random_missions
from pluto_fleet.trials.lives import tried
from tests.trials.examples import example, fleet_of
from tests.trials.mutants import MUTANTS

SEEDS = range(0, 8, 2)
BUDGET = 1500
"""Runs."""


def cases(app: App, fleet: FleetFile) -> Iterator[Case]:
    """What CI tries of one example: much by chance, then everything everywhere."""
    by_chance = (random_case(app, fleet, seed) for seed in range(300))
    small = (
        Case(
            seed=seed, missions=tuple(random_missions(app, fleet, seed)), fleet=fleet, weather=FAIR
        )
        for seed in SEEDS
    )
    return chain(by_chance, *(everywhere(app, case) for case in small))


@pytest.mark.parametrize("name", MUTANTS)
def test_every_mutant_is_found(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """By what it does, and in time."""
    mutant = MUTANTS[name]
    app = example(mutant.example, mutant.overrides, plain=mutant.plain)
    fleet = fleet_of(mutant.example, app)
    mutant.plant(monkeypatch)
    said: dict[str, None] = {}
    for number, case in enumerate(cases(app, fleet)):
        assert number < BUDGET, list(said)
        sentences = tried(app, case).violations
        said.update(dict.fromkeys(sentences[:1]))
        if any(re.search(mutant.says, sentence) for sentence in sentences):
            return
    pytest.fail(f"it was not found that {name}; what was said: {list(said)}")


def test_there_are_twelve_at_least() -> None:
    """So many were promised."""
    assert len(MUTANTS) >= 12
