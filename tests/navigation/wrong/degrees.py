"""Tells degrees, as its library does."""

from __future__ import annotations

from dataclasses import replace
from math import degrees

from pluto_fleet.drones import DroneTelemetry
from tests.navigation.simulated import Simulated

FOUND_BY = "test_it_counts_in_metres_and_radians_in_the_maps_frame"
SAYS = "radians are between"


class Wrong(Simulated):
    """57 is no angle."""

    def told(self) -> DroneTelemetry:
        told = super().told()
        return told if self.muted else replace(told, yaw=degrees(told.yaw))
