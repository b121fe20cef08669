"""What a simulated Crazyflie is fitted with, said as a fleet file would say it of a real one."""

from __future__ import annotations

from collections.abc import Mapping

from .drone import Build, SimulatedCrazyflie
from .record import InMemory
from .variables import parameters, variables

_SENSORS = {"temperature": "bme.temp", "humidity": "bme.humidity", "pressure": "baro.pressure"}
_ANY = {"*": "sim.measured"}
"""A sensor for every other quantity, also for those that nobody has asked for yet."""
_GRIP = {"parameter": "gripper.closed", "pick": 1, "release": 0, "seconds": 0.5}


def fitted(given: Mapping[str, object], camera: str) -> dict[str, object]:
    """Return the options of a simulated drone, whose camera streams there.

    They are those of the fleet file, which is known to be right; where that names a part of a real
    drone that a simulated one lacks, it has one of its own instead.
    """
    return {
        **given,
        "camera": camera,
        "cells": 1,
        "decks": [],
        "grip": _grip(given.get("grip")),
        "measure": {**_SENSORS, **_sensors(given.get("measure")), **_ANY},
    }


def _grip(given: object) -> Mapping[str, object]:
    if not isinstance(given, Mapping):
        return _GRIP
    if any(one.name == given["parameter"] for one in parameters()):
        return given
    return {**_GRIP, "seconds": given.get("seconds", _GRIP["seconds"])}


def _sensors(given: object) -> Mapping[str, str]:
    """Return which of the log variables that a file names there are."""
    there = variables(SimulatedCrazyflie(_SAMPLE, InMemory(), lambda _: None))
    named = given if isinstance(given, Mapping) else {}
    return {
        quantity: name if name in there else _SENSORS.get(quantity, _ANY["*"])
        for quantity, name in named.items()
    }


_SAMPLE = Build(id="any", home=(0.0, 0.0, 0.0))
