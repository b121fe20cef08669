"""Results are kept as they are given, and those that an evaluator has not seen are told from the others."""

from __future__ import annotations

from typing import Any

from pluto_fleet.shared.domain.model import Mission, Result, ResultStore, Trip
from pluto_fleet.shared.hooks.context import View


def test_every_result_is_found_again_however_many_there_are() -> None:
    store = ResultStore()
    missions = [Mission[Any](name=name, trips=[]) for name in "ab"]
    trip = Trip(name="A", action="measure", target=(0.0, 0.0, 1.0))
    given = [Result(missions[n % 2], trip, n // 7, n % 3 + 1, n) for n in range(5000)]
    for result in given:
        result.mission.last_result = store.add(result)
    everything = View(store.results)
    assert list(everything) == given
    assert (len(everything), everything[-1], everything[1:4]) == (
        5000,
        given[-1],
        tuple(given[1:4]),
    )
