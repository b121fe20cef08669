"""Where many want to go through one narrow place, each waits for those that were there before."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from measuring.narrow_places import PLACES, Place, flown, longest_wait


@pytest.mark.parametrize("is_real", [False, True])
@pytest.mark.parametrize("kind", PLACES)
@pytest.mark.parametrize(("seed", "drones"), [(2, 4), pytest.param(0, 14, marks=pytest.mark.long)])
@pytest.mark.parametrize("stays", [(0.0, 2.0, 10.0), (0.0, 240.0)])
def test_none_waits_longer_than_those_before_it_fly(
    kind: Callable[[float, float], Place],
    seed: int,
    drones: int,
    is_real: bool,
    stays: tuple[float, ...],
) -> None:
    """However long they stay; those that come later do not count."""
    flights, sky = flown(kind, seed, drones, is_real, stays)
    for flight in flights:
        assert flight.waited <= longest_wait(flight, flights), flight
    assert sky.nearest >= sky.apart - 1e-6
