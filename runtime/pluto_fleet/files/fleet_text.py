"""A fleet as the file that a person would write."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .behaviour import CRAZYFLIE, OWN
from .toml_text import key, numbers, text, value

if TYPE_CHECKING:
    from plutoc_runtime.domain.fleet_data import WorldData

    from .drones import DroneEntry
    from .fleet import FleetFile
    from .free_tables import Options


def fleet_text(fleet: FleetFile) -> str:
    """Return the fleet file."""
    return "\n".join(_fleet(fleet)) + "\n"


def _fleet(fleet: FleetFile) -> Iterator[str]:
    airspace = fleet.airspace
    yield "[map]"
    yield f"size = {numbers(airspace.size)}"
    yield f"cruise_height = {float(airspace.cruise_height)!r}"
    yield f"ceiling = {float(airspace.ceiling)!r}"
    if airspace.no_fly:
        areas = ", ".join(f"[{', '.join(map(numbers, area))}]" for area in airspace.no_fly)
        yield f"no_fly = [{areas}]"
    yield ""
    yield "[fleet]"
    yield f"after_trip = {text(fleet.after_trip.value)}"
    yield f"apart = {float(fleet.apart)!r}"
    if fleet.max_airborne is not None:
        yield f"max_airborne = {fleet.max_airborne}"
    if fleet.navigation != CRAZYFLIE:
        yield f"navigation = {text(fleet.navigation)}"
    if fleet.localization != OWN:
        yield f"localization = {text(fleet.localization)}"
    if fleet.localization_options:
        yield from _table("localization", fleet.localization_options)
    for name, options in fleet.options.items():
        yield from _table(f"navigation.{key(name)}", options)
    for drone in fleet.drones:
        yield from _drone(drone)
    if fleet.world is not None:
        yield from _world(fleet.world)


def _drone(drone: DroneEntry) -> Iterator[str]:
    yield ""
    yield "[[drone]]"
    yield f"id = {text(drone.id)}"
    yield f"category = {text(drone.category)}"
    yield f"home = {numbers(drone.home if drone.home[2] else drone.home[:2])}"
    if drone.uri is not None:
        yield f"uri = {text(drone.uri)}"
    if drone.navigation is not None:
        yield f"navigation = {text(drone.navigation)}"
    if drone.options:
        yield from _table("drone.options", drone.options)


def _table(header: str, options: Options) -> Iterator[str]:
    yield ""
    yield f"[{header}]"
    yield from (f"{key(name)} = {value(of)}" for name, of in options.items())


def _world(world: WorldData) -> Iterator[str]:
    yield ""
    yield "[world.background]"
    for quantity, level in world.background.items():
        yield f"{key(quantity)} = {level!r}"
    for source in world.sources:
        yield ""
        yield "[[world.source]]"
        yield f"quantity = {text(source.quantity)}"
        yield f"at = {numbers(source.at)}"
        yield f"peak = {float(source.peak)!r}"
        yield f"radius = {float(source.radius)!r}"
    for feature in world.features:
        yield ""
        yield "[[world.feature]]"
        yield f"kind = {text(feature.kind)}"
        yield f"at = {numbers(feature.at)}"
        yield f"radius = {float(feature.radius)!r}"
