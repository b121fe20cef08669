"""A small share of what `benchmarks/traffic.py` flies."""

from __future__ import annotations

import pytest

from traffic import APART, flown, measured
from traffic import crossings as crossing


@pytest.mark.parametrize(("runs", "drones"), [(60, 2), (6, 10)])
def test_trips_that_cross_keep_apart(runs: int, drones: int) -> None:
    """No two drones come nearer; without a distance some would."""
    assert measured(runs, drones, 10.0).nearest >= APART - 1e-6
    assert any(
        flown(*crossing(seed, drones, 10.0), 10.0, 0.0).nearest < APART for seed in range(runs)
    )
