"""Tells where it is once a second."""

from __future__ import annotations

import time

from pluto_fleet.drones import DroneTelemetry
from tests.navigation.simulated import Simulated

FOUND_BY = "test_telemetry_is_fresh"
SAYS = "it told nothing new for"


class Wrong(Simulated):
    """By then it is somewhere else."""

    def told(self) -> DroneTelemetry:
        now, before = super().told(), self.telemetry
        done = self.body.command == ""  # it knows when it has arrived
        return now if done or time.monotonic() - before.time > 0.9 else before
