"""Whole flights of Crazyflies through the unmodified cflib: to their end, and with killed processes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.flights_crazyflie.campaign import fly
from tests.flights_crazyflie.conftest import NewFlight
from tests.flights_crazyflie.judge import (
    astray,
    beside_its_target,
    dropped,
    left_in_the_air,
    nearest,
)
from tests.flights_crazyflie.plans import SIZE, WARD, fleet, missions, quick_package, targets
from tests.flights_crazyflie.scenarios import SCENARIOS
from tests.kill.trial import gateway_of

# minutes in real time; test_dry_run.py flies one through all of it
pytestmark = pytest.mark.long

APART = 0.5


def test_all_trips_are_completed_at_their_targets_and_every_drone_lands_before_its_link_closes(
    new_flight: NewFlight,
) -> None:
    flight = new_flight(missions(WARD), fleet(5), 5)
    flight.start()
    assert flight.see_through() == 0, flight.told
    assert set(flight.ends().values()) == {"COMPLETED"}, flight.told
    flight.until(lambda: gateway_of(flight.journal) is None)  # all links are closed
    events, commands, trace = flight.events, flight.commands, flight.trace
    assert list(beside_its_target(events, trace, targets(WARD))) == []
    assert [*dropped(commands), *left_in_the_air(commands), *astray(commands, SIZE)] == []
    least, who = nearest(trace)
    assert least > APART, who


pytest.importorskip("cflib")

CHOSEN = ("kill -9 of the brain", "kill -9 of the gateway")


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that the app's package is imported from."""
    return quick_package(tmp_path_factory.mktemp("quick"))


@pytest.mark.parametrize("name", CHOSEN)
def test_it_ends_as_meant(name: str, quick: Path, tmp_path: Path) -> None:
    scenario = next(one for one in SCENARIOS if one.name == name)
    flight, wrong = fly(scenario, quick, tmp_path)
    assert wrong == [], flight.told
