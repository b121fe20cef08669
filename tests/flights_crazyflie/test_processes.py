"""Processes are killed while Crazyflies fly: nothing falls, nothing hangs, all is flown in the end.

All faults, one by one: `python -m tests.flights_crazyflie.campaign`.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.flights_crazyflie.campaign import fly
from tests.flights_crazyflie.plans import quick_package
from tests.flights_crazyflie.scenarios import SCENARIOS

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
