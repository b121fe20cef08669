"""The navigation of forty lines that the pages show passes the kit."""

from __future__ import annotations

from math import pi
from pathlib import Path

import pytest
from wren import Wren

from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import DroneNavigation, DroneSetup


@pytest.mark.long
class TestWren(NavigationContract):
    """In real time, as a Wren flies."""

    height, speed, away, rest = 0.4, 1.0, 1.0, 0.2
    may_fall = together = True

    def make(self) -> DroneNavigation:
        return self.wren("wren:100,50")

    def make_unreachable(self) -> DroneNavigation:
        return self.wren("sparrow")

    def wren(self, uri: str) -> Wren:
        home = (1.0, 0.5, 0.0)
        return Wren(DroneSetup(id="w1", uri=uri, home=home, speed=1.0, options={}, folder=Path()))

    def silence(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Wren)
        navigation.radio.silent = True

    def crash(self, navigation: DroneNavigation) -> None:
        assert isinstance(navigation, Wren)
        navigation.radio.send("off")

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        assert isinstance(navigation, Wren)
        if (at := navigation.radio.at) is None:
            return None
        x, y, z = at
        turning = navigation.radio.mode in ("moving", "hovering")
        return Truth(position=(x / 100, y / 100, z / 100), yaw=pi / 2, motors=turning)
