"""The settings of the gateway's process: plain data, as it loads nothing of the app."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from ..drones.real_fleet import RealDrone, RealFleet, real_of
from ..shared.alone.faults import Faults
from ..shared.domain.airspace import Airspace
from ..shared.domain.app import moving
from ..shared.domain.fleet_data import Feature, Source, WorldData
from ..shared.domain.model import Category
from ..shared.domain.motion import Motion
from ..simulation.body import SimulatedDrone, simulated

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

    drones: tuple[SimulatedDrone, ...]
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
    return Settings(
        drones=tuple(simulated(moving(app, fleet.motion), fleet)),
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


def data_of(settings: Settings) -> dict[str, object]:
    """Return settings as plain data."""
    airspace, world = settings.airspace, settings.world
    return {
        "drones": list(map(_drone_data, settings.drones)),
        "airspace": {
            "size": airspace.size,
            "cruise_height": airspace.cruise_height,
            "ceiling": airspace.ceiling,
            "no_fly": airspace.no_fly,
        },
        "apart": settings.apart,
        "max_airborne": settings.max_airborne,
        "world": None if world is None else {**asdict(world), "background": {**world.background}},
        "seed": settings.seed,
        "faults": asdict(settings.faults),
        "real": None if settings.real is None else asdict(settings.real),
        "speed": settings.speed,
        "patience": settings.patience,
        "idle": settings.idle,
    }


def settings_of(data: Mapping[str, Any]) -> Settings:
    """Return stored settings."""
    return Settings(
        drones=tuple(map(_drone, data["drones"])),
        airspace=_airspace(data["airspace"]),
        apart=data["apart"],
        max_airborne=data.get("max_airborne"),
        world=None if data["world"] is None else _world(data["world"]),
        seed=data["seed"],
        faults=Faults(**data["faults"]),
        real=None if data["real"] is None else real_of(data["real"]),
        speed=data["speed"],
        patience=data["patience"],
        idle=data["idle"],
    )


def joining_data(drone: SimulatedDrone, real: RealDrone | None) -> dict[str, object]:
    """Return a drone that joins as plain data; `real`: how a real one is flown."""
    return {"drone": _drone_data(drone), "real": None if real is None else asdict(real)}


def joining_of(data: Mapping[str, Any]) -> tuple[SimulatedDrone, RealDrone | None]:
    """Return a drone that joins; raise `KeyError`, `TypeError` or `ValueError` if it is none."""
    real = data["real"]
    return _drone(data["drone"]), None if real is None else RealDrone(**real)


def _drone_data(drone: SimulatedDrone) -> dict[str, Any]:
    data, actions = asdict(drone), drone.category.actions
    data["category"]["actions"] = None if actions is None else sorted(actions)
    return data


def _drone(data: Mapping[str, Any]) -> SimulatedDrone:
    category, actions = data["category"], data["category"]["actions"]
    category["motion"] = Motion(**category["motion"])
    actions = None if actions is None else frozenset(actions)
    return SimulatedDrone(
        id=data["id"],
        category=Category(**{**category, "actions": actions}),
        home=tuple(data["home"]),
        index=data["index"],
        battery_level=data["battery_level"],
        charges_at_home=data["charges_at_home"],
    )


def _airspace(data: Mapping[str, Any]) -> Airspace:
    return Airspace(
        size=tuple(data["size"]),
        cruise_height=data["cruise_height"],
        ceiling=data["ceiling"],
        no_fly=tuple(tuple(map(tuple, area)) for area in data["no_fly"]),
    )


def _world(data: Mapping[str, Any]) -> WorldData:
    return WorldData(
        features=tuple(Feature(**{**one, "at": tuple(one["at"])}) for one in data["features"]),
        sources=tuple(Source(**{**one, "at": tuple(one["at"])}) for one in data["sources"]),
        background=data["background"],
    )
