"""A flight of real processes whose vehicles speak MAVLink, flown by MAVSDK and simulated with their autopilots."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, ClassVar

from pluto_fleet.autopilot import process
from pluto_fleet.shared.domain.errors import BadInput
from tests.flights_crazyflie.flight import Flight

_OFF_GROUND = 0.1
"""Metres above which a vehicle counts as being in the air."""


@dataclass(kw_only=True)
class VehicleFlight(Flight):
    """Flies simulated vehicles, and makes them."""

    flag: ClassVar[str] = "--mavlink-sim"

    @property
    def state(self) -> Mapping[str, Mapping[str, Any]]:
        told = json.loads(process.told(self.air, "state"))
        found: Mapping[str, Mapping[str, Any]] = told["vehicles"]
        return found

    def airborne(self) -> list[str]:
        with suppress(BadInput):
            return [id for id, one in self.state.items() if one["at"][2] > _OFF_GROUND]
        return []

    def end(self) -> None:
        super().end()
        process.end(self.air)
