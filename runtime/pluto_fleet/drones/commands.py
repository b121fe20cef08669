"""How each command is carried out by a drone's navigation: with a time-out, once what it needs is so.

A navigation in another package may use another copy of `Photo`, and numbers of its library's own
types: so the result of an action is converted. A result of the wrong kind is a bug of the navigation.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from math import dist, inf, isfinite
from typing import Any, SupportsFloat

from ..jobs.controls import (
    Act,
    Command,
    Cut,
    GoTo,
    Hold,
    Land,
    Read,
    See,
    TakeOff,
    Trigger,
    Write,
)
from ..jobs.reports import motors_cut
from ..shared.domain.actions import BUILT_IN, PICK, RELEASE, Plain
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.model import Item, Photo, Point, Sighting
from ..shared.domain.text import percent, place, shown
from .following import follow
from .protocol import Acts, ActsOnTheWay, Readable, Sees
from .telemetry import RISING
from .timeouts import shortened
from .vehicle import LAND, RISE, SLOWEST_PLANNED, TIME_MARGIN, Vehicle

LONGEST = 60


def result_of(drone: str, action: str, gave: object) -> object:
    """Convert a result to a number, a `Photo` or None; raise `FlightFailed` if it is none of these."""
    if action in (PICK, RELEASE):
        return None
    try:
        return _photo(gave) if action == "take_photo" else _number(gave)
    except (AttributeError, TypeError, ValueError):
        reason = f"the navigation of {drone} made a mistake: {action} gave {shown(gave)[:LONGEST]}"
        raise FlightFailed(Failure.ACTION, reason) from None


def _number(gave: object) -> float:
    if isinstance(gave, str) or not isinstance(gave, SupportsFloat):
        raise TypeError
    if not isfinite(number := float(gave)):
        raise ValueError
    return number


def _photo(gave: Any) -> Photo:
    """Convert a photo of any copy of the class."""
    x, y, z = gave.position
    file = getattr(gave, "file", None)
    return Photo(
        position=(_number(x), _number(y), _number(z)),
        width=_number(gave.width),
        height=_number(gave.height),
        sees=tuple(map(str, getattr(gave, "sees", ()))),
        tracks=tuple(map(_sighting, getattr(gave, "tracks", ()))),
        sharpness=_number(getattr(gave, "sharpness", 1.0)),
        file=None if file is None else str(file),
    )


async def do(vehicle: Vehicle, command: Command) -> object:
    """Carry out a command; those that move it, or act, one after the other."""
    match command:
        case TakeOff(height):
            await vehicle.does(RISE, take_off, height)
        case GoTo():
            turns = vehicle.commands.brakes
            if turns:  # it need not stop for that
                vehicle.commands.release()
            await vehicle.does("fly", go_to, command, turns)
        case Land():
            await vehicle.does(LAND, land)
        case Hold():
            await vehicle.does("hover", hold)
        case Act(action, parameters, item):
            return await vehicle.does(action, act, action, parameters, item)
        case Trigger(action, parameters):
            return await trigger(vehicle, action, parameters)
        case See():
            return await sees(vehicle)
        case Read(name):
            return await read(vehicle, name)
        case Write(name, value):
            await write(vehicle, name, value)
        case Cut():
            await cut(vehicle)
    return None


CUT_LIMIT = 2.0
"""The time-out of switching motors off on command, in seconds."""
LANDED_LIMIT = 3.0
"""Seconds after a landing within which a drone must report that it has landed."""


async def take_off(vehicle: Vehicle, height: float) -> None:
    """Take off straight up to a height; does nothing for a drone that flies."""
    vehicle.check()
    if not vehicle.telemetry.landed:
        return
    reasons = await vehicle.preflight()
    level, reserve = vehicle.telemetry.battery_level, vehicle.drone.category.reserve
    if level < reserve:
        left = f"{percent(level)} in its battery, and {percent(reserve)} are its reserve"
        reasons = (*reasons, left)
    if reasons:
        why = f"{vehicle.id} is not ready: {'; '.join(reasons)}"
        raise FlightFailed(Failure.REFUSED, why)
    vehicle.telemetry.rises_until, vehicle.looked_after = inf, False
    try:
        takeoff = vehicle.navigation.takeoff
        await vehicle.go("take off", vehicle.climbs(height), takeoff, height, vehicle.climb)
    finally:
        if vehicle.linked:  # until it reports whether it flies: it may have received the command
            vehicle.telemetry.rises_until = vehicle.calls.clock() + RISING


async def go_to(vehicle: Vehicle, command: GoTo, turns: bool = False) -> None:
    """Fly to a point, or elsewhere if it is told so on its way, without a stop.

    `turns`: it is on its way already.
    """
    vehicle.check()
    check_airborne(vehicle)
    while True:
        if turns:
            await vehicle.calls.parted()
        way = fly_on(vehicle, command) if turns or command.seconds else fly(vehicle, command.target)
        flies = asyncio.ensure_future(way)
        turned = vehicle.turned = asyncio.get_running_loop().create_future()
        try:
            await asyncio.wait((flies, turned), return_when=asyncio.FIRST_COMPLETED)
        finally:
            vehicle.turned = None
            if not flies.done():
                flies.cancel()
                await asyncio.wait((flies,))
            if not flies.cancelled():
                flies.exception()  # looked at here: the caller was cancelled, and asks no more
        if not turned.done() or (not flies.cancelled() and flies.exception() is not None):
            return flies.result()
        command = turned.result()
        turns = True


async def fly_on(vehicle: Vehicle, command: GoTo) -> None:
    """Fly on to a point, without a stop if it is on its way."""
    target, seconds = command
    limit = max(seconds, _seconds_to(vehicle, target))
    what = f"arrive at {place(target)}"
    await vehicle.go(what, limit, follow, vehicle.navigation, target, vehicle.speed, seconds)


async def fly(vehicle: Vehicle, target: Point) -> None:
    """Fly straight to a point, also where it takes no commands."""
    seconds = _seconds_to(vehicle, target)
    what = f"arrive at {place(target)}"
    await vehicle.go(what, seconds, vehicle.navigation.go_to, target, vehicle.speed)


def _seconds_to(vehicle: Vehicle, target: Point) -> float:
    """Return how many seconds a drone needs to a point, for time-outs."""
    return dist(vehicle.telemetry.location, target) / min(vehicle.speed, SLOWEST_PLANNED)


async def land(vehicle: Vehicle) -> None:
    """Land here, also where it takes no commands, if only it is linked; does nothing on the ground."""
    if vehicle.telemetry.landed:
        return
    if vehicle.is_cut:
        raise motors_cut(vehicle.id)
    if not vehicle.linked:
        vehicle.check()
    await vehicle.go("land", vehicle.sinks, vehicle.navigation.land, vehicle.climb)
    vehicle.telemetry.rises_until = -inf
    # its telemetry may be older than that
    if not await vehicle.until(lambda: vehicle.telemetry.landed, LANDED_LIMIT):
        raise FlightFailed(Failure.ACTION, f"{vehicle.id} was to land, and flies all the same")


async def hold(vehicle: Vehicle) -> None:
    """Hover until cancelled, or until something fails."""
    vehicle.check()
    check_airborne(vehicle)
    await asyncio.get_running_loop().create_future()


async def cut(vehicle: Vehicle) -> None:
    """Switch its motors off at once: its command is aborted, without a hover."""
    vehicle.is_cut = True
    vehicle.commands.release()
    try:
        await vehicle.calls.call(
            "switch its motors off", CUT_LIMIT, vehicle.navigation.emergency_stop
        )
    except FlightFailed:  # it could not be reached: it flies on
        vehicle.is_cut = False
        raise
    vehicle.must_land = False
    vehicle.refuse(motors_cut(vehicle.id))


def check_airborne(vehicle: Vehicle) -> None:
    """Raise `FlightFailed` for a drone that stands on the ground."""
    if vehicle.telemetry.landed:
        where = place(vehicle.telemetry.location)
        reason = f"{vehicle.id} is on the ground at {where}: it must take off first"
        raise FlightFailed(Failure.REFUSED, reason)


READ_LIMIT = 5.0
"""The time-out of reading or setting a value, in seconds."""


async def act(
    vehicle: Vehicle, action: str, parameters: Mapping[str, Plain], item: Item | None
) -> object:
    vehicle.check()
    check_airborne(vehicle)
    why = why_not(vehicle, action, parameters)
    if why is not None or not isinstance(vehicle.navigation, Acts):
        raise FlightFailed(Failure.REFUSED, why or f"{vehicle.id} has no action {action}")
    given = parameters.get("seconds")
    seconds = given if isinstance(given, (int, float)) else BUILT_IN[action].seconds
    value = await vehicle.go(
        action, seconds + TIME_MARGIN, vehicle.navigation.act, action, parameters, item
    )
    if action in (PICK, RELEASE):
        vehicle.cargo.carries(
            vehicle.id, item.name if action == PICK and item is not None else None
        )
    return result_of(vehicle.id, action, value)


def why_not(vehicle: Vehicle, action: str, parameters: Mapping[str, Plain]) -> str | None:
    """Return why its hardware cannot do an action, or None."""
    navigation = vehicle.navigation
    if action not in BUILT_IN or not isinstance(navigation, Acts):
        return f"{vehicle.id} has no action {action}"
    believed: str | None = (
        f"the navigation of {vehicle.id} cannot say whether it has the action {action}"
    )
    why = vehicle.calls.ask("why_not", lambda: navigation.why_not(action, parameters), believed)
    return why if why is None else shortened(str(why))


async def trigger(vehicle: Vehicle, action: str, parameters: Mapping[str, Plain]) -> object:
    """Do a built-in action at once, on the way."""
    vehicle.check()
    check_airborne(vehicle)
    navigation = vehicle.navigation
    if not isinstance(navigation, ActsOnTheWay):
        raise FlightFailed(Failure.ACTION, f"{vehicle.id} cannot {action} on its way")
    what = f"{action} on its way"
    value = await vehicle.calls.call(what, READ_LIMIT, navigation.trigger, action, parameters)
    return result_of(vehicle.id, action, value)


async def sees(vehicle: Vehicle) -> tuple[Sighting, ...]:
    """Return what moves in the view of its camera: nothing, on the ground."""
    vehicle.check()
    navigation = vehicle.navigation
    if not isinstance(navigation, Sees):
        raise FlightFailed(Failure.ACTION, f"{vehicle.id} has no camera that tells what moves")
    if vehicle.telemetry.landed:
        return ()
    seen = await vehicle.calls.call("see", READ_LIMIT, navigation.sees)
    try:
        return tuple(_sighting(one) for one in seen)
    except (AttributeError, TypeError, ValueError) as error:
        raise vehicle.calls.mistake("sees", error) from error


def _sighting(gave: Any) -> Sighting:
    """Convert a sighting of any copy of the class."""
    x, y, z = gave.at
    return Sighting(str(gave.track), str(gave.kind), (_number(x), _number(y), _number(z)))


async def read(vehicle: Vehicle, name: str) -> float:
    vehicle.check()
    if not isinstance(vehicle.navigation, Readable):
        raise FlightFailed(Failure.ACTION, f"{vehicle.id} has nothing that can be read")
    value = await vehicle.calls.call(f"read {name}", READ_LIMIT, vehicle.navigation.read, name)
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise vehicle.calls.mistake("read", error) from error


async def write(vehicle: Vehicle, name: str, value: float) -> None:
    vehicle.check()
    if not isinstance(vehicle.navigation, Readable):
        raise FlightFailed(Failure.ACTION, f"{vehicle.id} has nothing that can be written")
    await vehicle.calls.call(f"write {name}", READ_LIMIT, vehicle.navigation.write, name, value)
