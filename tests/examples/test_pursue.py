"""What the example of events promises: pictures within a bound, hand-overs without a gap, and who is let go."""

from __future__ import annotations

import pytest

from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.report.reactions import reactions_of
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.trials.case import fresh
from pluto_fleet.trials.invariants import violations
from tests.kit.apps import example
from tests.kit.pursuit import peopled, releases


def pursued(fleet: FleetFile, seed: int) -> SimulationResult:
    """Fly the example with a fleet, for an hour at most."""
    app = example("pursue")
    missions = [fresh(mission) for mission in app.missions]
    return simulate(
        app.app, missions, fleet, seed=seed, faults=Faults(), until=3600.0, on_event=None
    )


@pytest.mark.parametrize("seed", [1, 20])
def test_drones_that_are_kept_apart_take_over_within_reach(seed: int) -> None:
    """Each keeps to its own side of who is followed."""
    outcome = pursued(example("pursue").fleet, seed)
    found = reactions_of(outcome.events)
    intruder = found.events["intruder"]
    assert (intruder.raised, intruder.kept) == (3, 3)
    assert found.away
    assert found.gaps == 0


@pytest.mark.parametrize(("drones", "people", "seed"), [(3, 6, 1), (2, 8, 0)])
def test_too_few_drones_let_go_by_the_rule_and_nothing_hangs(
    drones: int, people: int, seed: int
) -> None:
    """Here people walk as fast as drones fly."""
    fleet = peopled(example("pursue").fleet, drones, people, seed, paces=(0.5, 1.0))
    outcome = pursued(fleet, seed)
    released, wrong = releases(outcome.events)
    assert wrong == []
    assert released > 0
    ended = {stands["ended"] for stands in outcome.standing["missions"].values()}
    assert ended == {True}
    assert violations(outcome.events, example("pursue").items) == []
