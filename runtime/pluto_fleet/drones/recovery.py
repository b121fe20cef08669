"""Recovery after a failed flight: until a drone takes commands again, or a person has put it home."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.text import place
from .vehicle import LOOK

if TYPE_CHECKING:
    from .connection import Connection
    from .vehicle import Vehicle


RECONNECT_LIMIT = 120.0
"""Seconds for which a lost link is tried to be restored."""
READY_LIMIT = 10.0
"""Seconds that a drone on the ground has to get ready: its position may have to settle."""
HOME_LIMIT = 600.0
"""Seconds within which a person must have put it home."""
BETWEEN_LOOKS = 2.0
"""The polling interval, in seconds."""


async def recover(vehicle: Vehicle, connection: Connection) -> bool:
    """Wait until a drone takes commands, or is down where it needs a person.

    Returns False if it is lost.
    """
    if not await connection.within(RECONNECT_LIMIT):
        return False
    if not await _has_landed(vehicle, connection):
        return False
    if not await vehicle.report_care():
        return False
    if not vehicle.telemetry.landed:
        return vehicle.down is None
    return vehicle.needs_person or await _is_ready(vehicle)


async def _has_landed(vehicle: Vehicle, connection: Connection) -> bool:
    """Wait while a drone lands by itself, or has not reported yet whether it flies."""
    patience = round(READY_LIMIT / LOOK)
    while vehicle.telemetry.is_rising or (
        not vehicle.telemetry.landed and vehicle.down is not None
    ):
        await asyncio.sleep(LOOK)
        patience -= not vehicle.must_land
        if patience < 0 or not (vehicle.linked or await connection.within(RECONNECT_LIMIT)):
            return False
    return True


async def _is_ready(vehicle: Vehicle) -> bool:
    """Return whether a drone on the ground can fly on, or may be waited for."""
    until = vehicle.calls.clock() + READY_LIMIT
    while (reasons := await _reasons(vehicle)) and vehicle.calls.clock() < until:
        await asyncio.sleep(BETWEEN_LOOKS)
    if not reasons:
        vehicle.clear_failure()
    elif vehicle.has_crashed:
        return False
    else:
        why = f"{vehicle.id} is not ready: {'; '.join(reasons)}"
        vehicle.refuse(FlightFailed(Failure.REFUSED, why), needs_person=True)
    return True


async def wait_until_home(vehicle: Vehicle) -> bool:
    """Wait until a drone is at home and ready; return False if not in time, or if it has crashed.

    One that crashes on its way is lost, so that its repair can be confirmed.
    """
    said: tuple[str, ...] = ()
    try:
        async with asyncio.timeout(HOME_LIMIT):
            while missing := await _missing(vehicle):
                if vehicle.has_crashed or not await vehicle.report_care():
                    return False
                _lands(vehicle)
                if missing != said:
                    vehicle.calls.say(f"{vehicle.id} is waited for: {'; '.join(missing)}")
                    said = missing
                await asyncio.sleep(BETWEEN_LOOKS)
    except TimeoutError:
        return False
    vehicle.clear_failure()
    return True


def _lands(vehicle: Vehicle) -> None:
    """Make a drone land that is not commanded any more."""
    if vehicle.linked and not vehicle.telemetry.landed and not vehicle.must_land:
        where = place(vehicle.telemetry.location)
        why = f"{vehicle.id} could not be flown home: it lands at {where}"
        vehicle.force_landing(vehicle.down or FlightFailed(Failure.REFUSED, why))


async def _missing(vehicle: Vehicle) -> tuple[str, ...]:
    """Return what keeps it from flying again."""
    if vehicle.linked and not vehicle.is_docked:
        return (f"put it home, at {place(vehicle.drone.home)}",)
    return await _reasons(vehicle)


async def _reasons(vehicle: Vehicle) -> tuple[str, ...]:
    """Return why it may not fly, apart from a low battery where it can be charged."""
    if not vehicle.linked:
        return (vehicle.out_of_reach,)
    if vehicle.is_docked and vehicle.telemetry.battery_level < vehicle.drone.category.reserve:
        return vehicle.missing_actions()
    return (*await vehicle.preflight(), *vehicle.missing_actions())
