"""A simulated Crazyflie has what the fleet file names, or something instead, and stays while it is wanted."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from pluto_fleet.crazyflie.options import options_of
from pluto_fleet.crtp.drone import EMPTY_WORLD, Build, SimulatedCrazyflie
from pluto_fleet.crtp.equipment import fitted
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.logs import quantities
from pluto_fleet.gateway.process import LOCK
from pluto_fleet.process import locks
from pluto_fleet.process.simulator import GATEWAY_LOCK
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import Source, WorldData

CAMERA = "127.0.0.1:5000"


def test_what_the_file_names_and_it_lacks_it_has_otherwise() -> None:
    """A deck of one's own is no reason not to take off."""
    options = options_of(
        fitted(
            {
                "camera": "192.168.4.1:5000",
                "cells": 2,
                "decks": ["bcFlow2", "myDeck"],
                "grip": {"parameter": "magnet.on", "pick": 1, "release": 0, "seconds": 3},
                "measure": {"pm10": "sps.pm10", "temperature": "my.temp", "height": "baro.asl"},
                "measure_seconds": 2,
            },
            CAMERA,
            EMPTY_WORLD,
        )
    )
    assert options.camera == ("127.0.0.1", 5000)
    assert options.cells == 1
    assert options.decks == ()
    assert options.grip is not None
    assert (options.grip.parameter, options.grip.seconds) == ("gripper.closed", 3.0)
    assert options.variable_of("pm10") == quantities(EMPTY_WORLD)["pm10"]
    assert options.variable_of("noise") == "sim.nothing"
    assert options.variable_of("temperature") == "bme.temp"
    assert (options.variable_of("height"), options.measure_seconds) == ("baro.asl", 2.0)


def test_they_stay_while_a_gateway_runs_that_has_nothing_to_tell_them(tmp_path: Path) -> None:
    """A mission may wait for hours, and its drones stand and are only listened to."""
    of_gateway, seen = tmp_path / LOCK, tmp_path / GATEWAY_LOCK
    assert not locks.is_taken(seen)
    lock = locks.take(of_gateway)
    assert lock is not None
    assert locks.is_taken(seen)
    assert locks.holder(seen) == os.getpid()
    os.close(lock)
    assert not locks.is_taken(seen)


def test_it_measures_what_simulated_drones_of_a_gateway_measure() -> None:
    """In the same world, where it is; what is not there is nothing."""
    dust = Source(quantity="pm10", at=(1.0, 2.0), peak=80.0, radius=2.0)
    world = World(3, Airspace(), WorldData(sources=(dust,)))
    drone = SimulatedCrazyflie(
        Build(id="cf1", home=(1.0, 2.0, 0.0)), FlightLog(), lambda _: None, world
    )
    drone.step(100.0)
    measured = {
        quantity: drone.variables[name][1]()
        for quantity, name in options_of(fitted({}, CAMERA, world)).measure.items()
    }
    assert measured["pm10"] == world.measure("pm10", (1.0, 2.0, 0.0), 100.0)
    assert measured["pm10"] == pytest.approx(100.0, rel=0.01)
    assert measured["temperature"] == world.measure("temperature", (1.0, 2.0, 0.0), 100.0)
    assert measured["*"] == 0.0
