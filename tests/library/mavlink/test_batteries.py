"""How full a vehicle's battery is where its autopilot does not say so, as one without a current sensor."""

from __future__ import annotations

import pytest

from pluto_fleet.drones.battery_gauge import BatteryGauge
from pluto_fleet.lithium import volts_at
from pluto_fleet.mavlink.options import VehicleOptions
from pluto_fleet.mavlink.preflight import problems
from pluto_fleet.mavlink.state import VehicleState

CELLS = 4
WELL = {
    "is_gyrometer_calibration_ok": True,
    "is_accelerometer_calibration_ok": True,
    "is_magnetometer_calibration_ok": True,
    "is_global_position_ok": True,
    "is_home_position_ok": True,
    "is_armable": True,
}


def standing(cells: int | None, level: float) -> VehicleState:
    """Return the state of one with four cells that tells their voltage, and not how full they are."""
    gauge = None if cells is None else BatteryGauge(cells)
    state = VehicleState(None, 0.0, gauge)
    state.hear("health", WELL)
    state.hear("battery", {"volts": CELLS * volts_at(level), "percent": -1.0})
    return state


def test_its_voltage_says_so_where_the_fleet_file_says_how_many_cells_it_has() -> None:
    state = standing(CELLS, 0.7)
    assert state.battery == pytest.approx(0.7)
    assert problems(state, None, VehicleOptions()) == []


@pytest.mark.parametrize("cells", [None, 3])
def test_it_does_not_take_off_without_that_nor_with_too_few(cells: int | None) -> None:
    (why,) = problems(standing(cells, 0.7), None, VehicleOptions())
    assert "cells = 4" in why


def test_what_it_says_itself_counts_more() -> None:
    state = standing(CELLS, 0.7)
    state.hear("battery", {"volts": CELLS * volts_at(0.7), "percent": 31.0})
    assert state.battery == pytest.approx(0.31)
