"""The settings of the gateway's process: plain data, as it loads nothing of the app."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import msgspec

from ..drones.real_fleet import RealDrone, RealFleet
from ..jobs.controls import FleetDrone, fleet_drones
from ..shared.alone.world import Faults
from ..shared.domain.airspace import Airspace
from ..shared.domain.app import moving
from ..shared.domain.fleet_data import WorldData

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile

PATIENCE = 3.0
"""Seconds without a heartbeat of the brain, after which all drones land."""
IDLE = 60.0
"""Seconds without a brain and without a drone in the air, after which the gateway ends."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """A fleet of drones, and how it is flown."""

    drones: tuple[FleetDrone, ...]
    airspace: Airspace
    apart: float
    world: WorldData | None
    seed: int
    faults: Faults
    real: RealFleet | None = None
    """None: the drones are simulated."""
    max_airborne: int | None = None
    """The maximum number of drones in the air."""
    speed: float = 1.0
    """How fast time passes: 10 is ten times real time."""
    patience: float = PATIENCE
    """Seconds on the wall."""
    idle: float = IDLE
    """Seconds on the wall."""


def settings_for(
    app: App,
    fleet: FleetFile,
    *,
    seed: int,
    faults: Faults | None = None,
    real: RealFleet | None = None,
    speed: float = 1.0,
    patience: float = PATIENCE,
) -> Settings:
    """Return the settings for the fleet of an app."""
    moved = moving(app, fleet.motion, charges=fleet.charges_at_home)
    return Settings(
        drones=tuple(fleet_drones(moved, fleet)),
        airspace=fleet.airspace,
        apart=fleet.apart,
        max_airborne=fleet.max_airborne,
        world=fleet.world,
        seed=seed,
        faults=faults or Faults(),
        real=real,
        speed=speed,
        patience=patience,
    )


def data_of(settings: Settings) -> dict[str, Any]:
    """Return settings as plain data."""
    data: dict[str, Any] = msgspec.to_builtins(settings, enc_hook=dict, order="deterministic")
    return data


def settings_of(data: Mapping[str, Any]) -> Settings:
    """Return stored settings; raise `ValueError` if these are none."""
    return msgspec.convert(data, Settings)


@dataclass(frozen=True, slots=True, kw_only=True)
class Joining:
    """A drone that joins a fleet in flight."""

    drone: FleetDrone
    real: RealDrone | None
    """How a real one is flown."""


def joining_data(drone: FleetDrone, real: RealDrone | None) -> dict[str, object]:
    """Return a drone that joins as plain data."""
    data: dict[str, object] = msgspec.to_builtins(Joining(drone=drone, real=real), enc_hook=dict)
    return data


def joining_of(data: Mapping[str, Any]) -> Joining:
    """Return a drone that joins; raise `ValueError` if it is none."""
    return msgspec.convert(data, Joining)
