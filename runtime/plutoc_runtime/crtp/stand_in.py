"""What a simulated Crazyflie is fitted with, said as a fleet file would say it of a real one."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from .process import told

if TYPE_CHECKING:
    from ..drones.real_fleet import Wanted

_SENSORS = {"temperature": "bme.temp", "humidity": "bme.humidity", "pressure": "baro.pressure"}
_ANY = "sim.measured"
"""The log variable for any other quantity."""


def fitted(folder: Path, wanted: Iterable[Wanted]) -> Mapping[str, object]:
    """Return the options for the simulated drones of a folder: camera, gripper and sensors.

    There is a sensor for whatever the plan wants to be measured.
    """
    quantities = [str(one.parameters.get("quantity", "temperature")) for one in wanted]
    return {
        "camera": told(folder, "camera"),
        "grip": {"parameter": "gripper.closed", "pick": 1, "release": 0, "seconds": 0.5},
        "measure": {quantity: _SENSORS.get(quantity, _ANY) for quantity in quantities},
    }
