"""A simulated Crazyflie has what the fleet file names, or something instead, and stays while it is wanted."""

from __future__ import annotations

import os
from pathlib import Path

from pluto_fleet.crazyflie.options import options_of
from pluto_fleet.crtp.equipment import fitted
from pluto_fleet.crtp.process import GATEWAY_LOCK
from pluto_fleet.gateway.process import LOCK
from pluto_fleet.process import locks

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
        )
    )
    assert options.camera == ("127.0.0.1", 5000)
    assert options.cells == 1
    assert options.decks == ()
    assert options.grip is not None
    assert (options.grip.parameter, options.grip.seconds) == ("gripper.closed", 3.0)
    assert options.variable_of("pm10") == "sim.measured"
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
