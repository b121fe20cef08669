"""What a fleet file says of real drones: how each is flown, and what keeps it from being reached."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from . import errors
from .behaviour import CRAZYFLIE

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .fleet import DroneEntry, FleetFile
    from .free_tables import Options

FOLLOWED = 1.0
"""Metres per second: no course is followed faster, as the firmware comes (`posCtlPid.xVelMax`)."""
PACE = 16 / 35
"""A Crazyflie's mean speed on a course, as a share of its peak speed."""


def navigation_of(fleet: FleetFile, drone: DroneEntry) -> str:
    """Return how a drone is flown: a name, or `module:Class`."""
    return drone.navigation or fleet.navigation


def options_of(fleet: FleetFile, drone: DroneEntry) -> Options:
    """Return what is for its navigation: the fleet's options, and the drone's own on top."""
    return {**fleet.options.get(navigation_of(fleet, drone), {}), **drone.options}


def not_real(fleet: FleetFile) -> list[str]:
    """Return why this fleet cannot be flown with real drones, a sentence each."""
    if all(drone.line is None for drone in fleet.drones):
        return [errors.no_fleet_file()]
    return [
        errors.no_uri(drone.id, drone.line)
        for drone in fleet.drones
        if drone.uri is None and navigation_of(fleet, drone) == CRAZYFLIE
    ]


def too_fast(app: App, fleet: FleetFile) -> list[str]:
    """Return which categories are faster than a Crazyflie follows as it comes, a sentence each."""
    flown = {
        d.category
        for d in fleet.drones
        if d.line is not None and navigation_of(fleet, d) == CRAZYFLIE
    }
    return [
        errors.too_fast(category.name, speed, FOLLOWED)
        for category in app.categories
        if category.name in flown and (speed := category.top_speed or category.speed) > FOLLOWED
    ]


def as_flown(app: App, fleet: FleetFile) -> App:
    """Return the app with its categories as slow as this fleet's real drones are on average.

    A Crazyflie's courses begin and end at rest: their peak speed, which a category limits, is 35/16 of
    their mean one.
    """
    slow = {d.category for d in fleet.drones if navigation_of(fleet, d) == CRAZYFLIE}
    categories = tuple(
        (
            replace(category, speed=category.speed * PACE, top_speed=category.speed)
            if category.name in slow and category.top_speed is None
            else category
        )
        for category in app.categories
    )
    return replace(app, categories=categories)
