"""What drones fly is measured in real flights: in a trial with that, nothing else happens."""

from __future__ import annotations

from functools import partial

import pytest

from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.trials import world
from pluto_fleet.trials.explore import random_case
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.record import TrialResult
from tests.trials.examples import example, fleet_of

APP = example("drugs_distribution_retry")
FLEET = fleet_of("drugs_distribution_retry", APP)


def _measured(seed: int, monkeypatch: pytest.MonkeyPatch) -> TrialResult:
    with monkeypatch.context() as patch:
        patch.setattr(world, "Gateway", partial(Gateway, measures=True))
        return tried(APP, random_case(APP, FLEET, seed))


@pytest.mark.parametrize("seed", range(3))
def test_measurements_change_nothing(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """No row more, no other instant, no other event, whatever strikes."""
    plain, measured = tried(APP, random_case(APP, FLEET, seed)), _measured(seed, monkeypatch)
    others = tuple(event for event in measured.events if event["event"] != "drone.flew")
    assert len(others) < len(measured.events)
    assert others == plain.events
    assert (measured.times, measured.acts, measured.ends) == (plain.times, plain.acts, plain.ends)
    assert measured.wrong == plain.wrong == ()
