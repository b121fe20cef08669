"""Wilson's bounds, and how often the rule promises what it should not: computed, not sampled."""

from __future__ import annotations

from collections import defaultdict

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.sizing.tries import Rule, least_runs, lower, upper, usual_runs


def test_the_bounds_are_wilsons() -> None:
    """As tables give them: one-sided, 95 %."""
    assert lower(100, 5) == pytest.approx(0.90084, abs=1e-5)
    assert upper(100, 5) == pytest.approx(0.97545, abs=1e-5)
    assert (lower(0, 0), upper(0, 0)) == (0.0, 1.0)
    assert upper(50, 0) == pytest.approx(1.0)
    assert lower(50, 50) == pytest.approx(0.0)


@pytest.mark.parametrize("confidence", [0.5, 0.8, 0.9, 0.95, 0.99, 0.999, 0.9999])
def test_the_least_runs_are_just_enough(confidence: float) -> None:
    """One fewer shows nothing, though all succeed."""
    least = least_runs(confidence)
    assert lower(least, 0) >= confidence > lower(least - 1, 0)
    assert usual_runs(confidence) >= least


def test_too_few_runs_are_refused_with_how_many_it_takes() -> None:
    """Before anything flies."""
    with pytest.raises(BadInput, match="100 runs cannot show 99 %: that takes 268 or more"):
        Rule(confidence=0.99, runs=100)


def outcomes(rule: Rule, probability: float) -> tuple[float, float, float]:
    """Return how probably a fleet is promised or refused, and how many runs that takes on average."""
    going, promised, refused, flown = {0: 1.0}, 0.0, 0.0, 0.0
    for runs in range(1, rule.runs + 1):
        flown += sum(going.values())
        after: dict[int, float] = defaultdict(float)
        for failed, chance in going.items():
            after[failed] += chance * probability
            after[failed + 1] += chance * (1 - probability)
        going = {}
        for failed, chance in after.items():
            if rule.refused(runs, failed):
                refused += chance
            elif rule.promised(runs, failed):
                promised += chance
            else:
                going[failed] = chance
    return promised, refused, flown


@pytest.mark.parametrize("confidence", [0.9, 0.95, 0.99])
def test_what_just_misses_is_seldom_promised(confidence: float) -> None:
    """About one in twenty at the very edge, hardly any further off; and the runs always decide."""
    rule = Rule(confidence=confidence, runs=usual_runs(confidence))
    at_the_edge, refused, _ = outcomes(rule, confidence - 1e-9)
    assert at_the_edge < 0.07
    assert at_the_edge + refused == pytest.approx(1.0)
    assert outcomes(rule, confidence - 0.2 * (1 - confidence))[0] < 0.015


def test_what_is_clear_is_decided_early() -> None:
    """A fleet that never fails takes half of the runs, one that mostly does takes twenty."""
    rule = Rule(confidence=0.99, runs=1000)
    promised, _, flown = outcomes(rule, 1.0)
    assert promised == pytest.approx(1.0)
    assert flown < 540
    _, refused, flown = outcomes(rule, 0.3)
    assert refused > 0.999
    assert flown < 9
    promised, _, _ = outcomes(rule, 0.999)
    assert promised > 0.99
