"""Dates what the drone told with the moment at which it is asked."""

from __future__ import annotations

import time
from dataclasses import replace
from math import isfinite

from pluto_fleet.drones import DroneTelemetry
from tests.navigation.simulated import Simulated

FOUND_BY = "test_a_drone_that_falls_silent_is_a_lost_link"
SAYS = "it is when the drone told it"


class Wrong(Simulated):
    """That it is silent is not seen."""

    @property
    def telemetry(self) -> DroneTelemetry:
        told = super().telemetry
        return replace(told, time=time.monotonic()) if isfinite(told.time) else told
