"""Flights of Crazyflies, flown once for all tests of a module."""

from __future__ import annotations

import pytest

from tests.crazyflie.hangar import Outcomes, all_at_once


@pytest.fixture(scope="module")
def outcomes(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Outcomes:
    """Fly the module's `FLIGHTS` all at once, each with a drone of its own."""
    return all_at_once(request.module.FLIGHTS, lambda: tmp_path_factory.mktemp("flight"))
